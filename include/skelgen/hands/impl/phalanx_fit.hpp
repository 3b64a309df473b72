#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/hands/impl/digit_tubes.hpp>

namespace skelgen::hands {

/// The phalanges of a digit as a chain of balls whose radii change along each phalanx.
template <typename Scalar = double>
struct PhalanxChain {
    std::vector<Vector3<Scalar>> places = {}; ///< joints from the innermost one on, and the centre of the end's ball
    std::vector<Scalar> radii = {};           ///< per place
};

/// What is known of a digit before its surface is looked at.
template <typename Scalar = double>
struct ExpectedPhalanges {
    std::vector<Scalar> shares = {}; ///< of each phalanx in their sum, which is 1; the last one's ends on the surface
    Scalar length = 0;               ///< of all together
};

namespace detail {

/// How much is believed: standard deviations, of shares and length relative to the expected length, of the rest
/// relative to the digit's mean radius. Chosen on generated hands and on rigs of characters; doubled or halved, they
/// change joints' median errors by less than a fifth on rigs.
struct PhalanxDeviations {
    static constexpr double shares = 0.15, length = 0.15;
    static constexpr double surface = 0.1;  ///< of the surface from the chain
    static constexpr double radii = 0.1;    ///< of the radius from one place to the next
    static constexpr double web = 0.1;      ///< of where the digit joins its neighbours from the first phalanx
    static constexpr double outlier = 0.25; ///< beyond which the surface is not the digit's own: webs, nails, rings
};

/// The normal equations of one step: unknowns are all places, then all radii, in mean radii of the digit.
class ChainFit {
public:
    using Number = core::Accumulator; // squares of what nearly cancels are solved for
    using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    using Place = Eigen::Matrix<Number, 3, 1>;

    ChainFit(std::vector<Place> places, std::vector<Number> radii)
        : places_(std::move(places)), radii_(std::move(radii)) {}

    [[nodiscard]] const std::vector<Place>& places() const { return places_; }
    [[nodiscard]] const std::vector<Number>& radii() const { return radii_; }

    void step(const std::vector<Place>& points, const std::vector<Number>& weights, const std::vector<Number>& shares,
              Number length, const Place& web, Number damping) {
        const Eigen::Index unknowns = 4 * size();
        matrix_ = Eigen::MatrixXd::Identity(unknowns, unknowns) * damping;
        right_ = Vector::Zero(unknowns);
        for (std::size_t i = 0; i < points.size(); ++i) add_point(points[i], weights[i]);
        add_web(web);
        add_lengths(shares, length);
        for (Eigen::Index k = 1; k < size(); ++k) {
            Vector row = Vector::Zero(unknowns);
            row[radius(k)] = 1;
            row[radius(k - 1)] = -1;
            add(row, radii_[at(k)] - radii_[at(k - 1)], PhalanxDeviations::radii);
        }
        move_by(matrix_.ldlt().solve(-right_));
    }

private:
    static std::size_t at(Eigen::Index k) { return static_cast<std::size_t>(k); }
    [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(places_.size()); }
    [[nodiscard]] Eigen::Index radius(Eigen::Index k) const { return 3 * size() + k; }

    void add(const Vector& row, Number residual, Number deviation) {
        matrix_ += row * row.transpose() / (deviation * deviation);
        right_ += row * (residual / (deviation * deviation));
    }

    void add_point(const Place& point, Number weight) {
        // The digit goes on behind its first place, at most by half a phalanx.
        constexpr Number behind = -0.5;
        Eigen::Index nearest = 0;
        Number least = std::numeric_limits<Number>::max(), part = 0;
        Place away = Place::Zero();
        for (Eigen::Index k = 0; k + 1 < size(); ++k) {
            const Place bone = places_[at(k + 1)] - places_[at(k)];
            const Number along =
                bone.dot(point - places_[at(k)]) / std::max(bone.squaredNorm(), std::numeric_limits<Number>::min());
            const Number t = std::clamp(along, k == 0 ? behind : Number(0), Number(1));
            const Place from = point - (places_[at(k)] + t * bone);
            const Number distance = from.norm() - ((1 - t) * radii_[at(k)] + t * radii_[at(k + 1)]);
            if (distance >= least) continue;
            least = distance;
            nearest = k;
            part = t;
            away = from;
        }
        const Number length = away.norm();
        if (!(length > 0)) return;
        away /= length;
        const Number far = least / PhalanxDeviations::outlier, trust = 1 / (1 + far * far); // as of Geman and McClure
        Eigen::Matrix<Number, 8, 1> row;
        row << -(1 - part) * away, -part * away, -(1 - part), -part;
        const Number scale = weight * trust * trust / (PhalanxDeviations::surface * PhalanxDeviations::surface);
        const auto index = [&](Eigen::Index i) { return i < 6 ? 3 * nearest + i : radius(nearest) + i - 6; };
        for (Eigen::Index i = 0; i < row.size(); ++i) {
            right_[index(i)] += scale * row[i] * least;
            for (Eigen::Index j = 0; j < row.size(); ++j) matrix_(index(i), index(j)) += scale * row[i] * row[j];
        }
    }

    /// The first phalanx goes through it.
    void add_web(const Place& web) {
        const Place bone = (places_[1] - places_[0]).normalized();
        const Number length = (places_[1] - places_[0]).norm(), part = bone.dot(web - places_[0]) / length;
        const Place away = web - (places_[0] + part * length * bone);
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            const Place across = Place::Unit(axis) - bone[axis] * bone;
            Vector row = Vector::Zero(4 * size());
            row.segment<3>(0) = -(1 - part) * across;
            row.segment<3>(3) = -part * across;
            add(row, away[axis], PhalanxDeviations::web);
        }
    }

    /// The last phalanx ends on the surface, one radius beyond its place.
    void add_lengths(const std::vector<Number>& shares, Number length) {
        std::vector<Vector> rows;
        std::vector<Number> lengths;
        Vector sum = Vector::Zero(4 * size());
        Number whole = 0;
        for (Eigen::Index k = 0; k + 1 < size(); ++k) {
            const Place bone = places_[at(k + 1)] - places_[at(k)];
            Vector row = Vector::Zero(4 * size());
            row.segment<3>(3 * (k + 1)) = bone.normalized();
            row.segment<3>(3 * k) = -bone.normalized();
            Number own = bone.norm();
            if (k + 2 == size()) {
                row[radius(k + 1)] = 1;
                own += radii_[at(k + 1)];
            }
            sum += row;
            whole += own;
            rows.push_back(std::move(row));
            lengths.push_back(own);
        }
        for (std::size_t k = 0; k < rows.size(); ++k)
            add(rows[k] - shares[k] * sum, lengths[k] - shares[k] * whole, PhalanxDeviations::shares * length);
        add(sum, whole - length, PhalanxDeviations::length * length);
    }

    /// Never by more than most of a radius at once.
    void move_by(Vector change) {
        constexpr Number most = 0.7, least_radius = 0.2;
        for (Eigen::Index k = 0; k < size(); ++k) {
            Place by = change.segment<3>(3 * k);
            if (const Number length = by.norm(); length > most) by *= most / length;
            places_[at(k)] += by;
            radii_[at(k)] = std::max(least_radius, radii_[at(k)] + std::clamp(change[radius(k)], -most, most));
        }
    }

    std::vector<Place> places_;
    std::vector<Number> radii_;
    Eigen::MatrixXd matrix_;
    Vector right_;
};

} // namespace detail

/// The chain whose surface a tube's own is nearest to, as hands are tracked (TPT16): its joints are where the digit
/// bends. Where it is straight, nothing but what is expected tells them. Starts from the given chain; Gauss-Newton,
/// always as many steps. The chain itself where the tube has too few points. O(points).
template <typename Scalar>
PhalanxChain<Scalar> fit_phalanges(const DigitTube<Scalar>& tube, PhalanxChain<Scalar> start,
                                   const ExpectedPhalanges<Scalar>& expected) {
    constexpr std::size_t least_points = 12;
    constexpr int steps = 25, first_steps = 10;
    using Number = detail::ChainFit::Number;
    using Place = detail::ChainFit::Place;
    if (tube.points.size() < least_points) return start;
    Number unit = 0, area = 0;
    for (const Scalar radius : start.radii) unit += static_cast<Number>(radius);
    unit /= static_cast<Number>(start.radii.size());
    for (const Scalar own : tube.areas) area += static_cast<Number>(own);
    if (!(unit > 0 && area > 0)) return start;

    const Vector3<Scalar> origin = tube.axis.back();
    const auto to_units = [&](const Vector3<Scalar>& p) -> Place {
        return (p - origin).template cast<Number>() / unit;
    };
    std::vector<Place> places, points;
    std::vector<Number> radii, weights, shares;
    for (const auto& place : start.places) places.push_back(to_units(place));
    for (const Scalar radius : start.radii) radii.push_back(static_cast<Number>(radius) / unit);
    for (const auto& point : tube.points) points.push_back(to_units(point));
    for (const Scalar own : tube.areas) weights.push_back(static_cast<Number>(own) / area);
    for (const Scalar share : expected.shares) shares.push_back(static_cast<Number>(share));

    detail::ChainFit fit(std::move(places), std::move(radii));
    for (int step = 0; step < steps; ++step)
        fit.step(points, weights, shares, static_cast<Number>(expected.length) / unit, to_units(tube.axis.front()),
                 step < first_steps ? 0.1 : 0.01);
    for (std::size_t k = 0; k < start.places.size(); ++k) {
        start.places[k] = origin + (unit * fit.places()[k]).template cast<Scalar>();
        start.radii[k] = static_cast<Scalar>(unit * fit.radii()[k]);
    }
    return start;
}

} // namespace skelgen::hands
