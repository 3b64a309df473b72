#pragma once

// What the weights of a skin have to hold, whatever the body.

#include <set>
#include <utility>
#include <vector>

#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::test {

/// The limbs (role's part and side) that move a vertex by more than `least`.
template <typename Scalar>
int limbs_followed(const applications::Skin<Scalar>& skin, Eigen::Index vertex, const SkeletonTemplate& human,
                   double least) {
    std::set<std::pair<BodyPart, Side>> limbs;
    for (int k = 0; k < applications::Skin<Scalar>::influences; ++k) {
        const TemplateJoint& joint = human.joint(skin.joints(vertex, k));
        if (static_cast<double>(skin.weights(vertex, k)) > least && part_of(joint.role) != BodyPart::trunk)
            limbs.insert({part_of(joint.role), joint.side});
    }
    return static_cast<int>(limbs.size());
}

/// How many vertices follow most a joint that none of their neighbours follows most.
template <typename Scalar>
int islands(const applications::Skin<Scalar>& skin, const Triangles& faces) {
    std::vector<bool> used(static_cast<std::size_t>(skin.joints.rows()), false), joined = used;
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = faces(f, k), w = faces(f, (k + 1) % 3);
            used[static_cast<std::size_t>(v)] = true;
            if (skin.joints(v, 0) != skin.joints(w, 0)) continue;
            joined[static_cast<std::size_t>(v)] = joined[static_cast<std::size_t>(w)] = true;
        }
    int count = 0;
    for (std::size_t v = 0; v < used.size(); ++v) count += used[v] && !joined[v] ? 1 : 0;
    return count;
}

} // namespace skelgen::test
