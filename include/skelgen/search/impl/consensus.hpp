#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::search {

/// Do two skeletons have left and right on the same sides? One row per joint of the template, not finite where it is
/// absent.
inline bool have_same_sides(const Points<double>& a, const Points<double>& b, const SkeletonTemplate& wanted) {
    double along = 0;
    for (int left = 0; left < static_cast<int>(wanted.joints.size()); ++left) {
        const int right = counterpart(wanted, left);
        if (wanted.joint(left).side != Side::left || right < 0) continue;
        const double both = (a.row(left) - a.row(right)).dot(b.row(left) - b.row(right));
        if (std::isfinite(both)) along += both;
    }
    return along >= 0;
}

/// Do two skeletons lack the same joints, or none? Rows as before.
inline bool have_same_joints(const Points<double>& a, const Points<double>& b) {
    return (a.col(0).array().isFinite() == b.col(0).array().isFinite()).all();
}

/// The place whose expected distance to a joint is least that is at each of `places` with these odds: their geometric
/// median, by Weiszfeld's iteration (Wei37) from `start`. One finite row each. `start` where none has odds. O(places).
inline Vector3<double> expected_place(const Points<double>& places, const std::vector<double>& odds,
                                      const Vector3<double>& start) {
    constexpr int rounds = 30;
    constexpr double smallest = 1e-4; // of what the places span: a distance that divides
    double span = 0;
    for (const auto& place : places.rowwise()) span = std::max(span, (place.transpose() - start).norm());
    if (!(span > 0)) return start;
    Vector3<double> out = start;
    for (int round = 0; round < rounds; ++round) {
        Vector3<double> sum = Vector3<double>::Zero();
        double weights = 0;
        for (Eigen::Index i = 0; i < places.rows(); ++i) {
            const Vector3<double> place = places.row(i).transpose();
            const double weight = odds[static_cast<std::size_t>(i)] / std::max((place - out).norm(), smallest * span);
            sum += weight * place;
            weights += weight;
        }
        if (!(weights > 0)) return start;
        out = sum / weights;
    }
    return out;
}

/// Each joint of one skeleton where all together expect it that have the same joints, and left and right on its sides:
/// where a limb is lacking, those that have it have put it elsewhere. `weights`: of each skeleton. One row per joint of
/// the template, not finite where it is absent. O(skeletons x joints).
inline Points<double> expected_places(const std::vector<Points<double>>& skeletons, const std::vector<double>& weights,
                                      std::size_t of, const SkeletonTemplate& wanted) {
    std::vector<const Points<double>*> heard;
    std::vector<double> odds;
    for (std::size_t i = 0; i < skeletons.size(); ++i) {
        if (skeletons[i].rows() == 0 || !have_same_joints(skeletons[i], skeletons[of]) ||
            !have_same_sides(skeletons[i], skeletons[of], wanted))
            continue;
        heard.push_back(&skeletons[i]);
        odds.push_back(weights[i]);
    }
    Points<double> out = skeletons[of];
    Points<double> places(static_cast<Eigen::Index>(heard.size()), 3);
    for (Eigen::Index j = 0; j < out.rows(); ++j) {
        for (Eigen::Index i = 0; i < places.rows(); ++i) places.row(i) = heard[static_cast<std::size_t>(i)]->row(j);
        if (out.row(j).allFinite()) out.row(j) = expected_place(places, odds, out.row(j).transpose()).transpose();
    }
    return out;
}

} // namespace skelgen::search
