#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/limb_regions.hpp>
#include <skelgen/applications/joint_weights.hpp>
#include <skelgen/applications/surface_laplacian.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// What warms a surface, in one pose or in several.
struct Heat {
    Eigen::SparseMatrix<core::Accumulator> conduction; ///< n x n, positive semi-definite: `surface_laplacian`
    Eigen::VectorX<core::Accumulator> supply;   ///< per vertex its area over the squared distance of what heats it
    Eigen::MatrixX<core::Accumulator> of_joint; ///< n x joints: of that what comes from each joint
};

namespace detail {

/// The bones that heat a vertex, and how far they are; none where none is seen.
template <typename Scalar>
struct HeatSources {
    std::vector<int> joints; ///< with repetitions where several bones are as near
    Scalar distance = 0;
};

/// Is the vertex what a look from a place inside the body meets first?
template <typename Scalar>
bool is_seen_from(const Vector3<Scalar>& place, const Vector3<Scalar>& vertex, const Body<Scalar>& body) {
    constexpr Scalar nearly = Scalar(0.98); // the look ends at the vertex's own faces, which may slant
    const Scalar distance = (vertex - place).norm();
    if (!(distance > 0)) return true;
    const Vector3<Scalar> direction = (vertex - place) / distance;
    return body.tree.first_along(body.mesh, place, direction).distance >= nearly * distance;
}

/// May the bone of a joint heat a vertex?
inline bool may_heat(const LimbRegions& regions, int joint, std::size_t vertex) {
    if (regions.of_joint.empty() || regions.of_vertex[vertex] < 0) return true;
    const int limb = regions.of_joint[static_cast<std::size_t>(joint)];
    return limb < 0 || limb == regions.of_vertex[vertex];
}

/// Is a vertex on the surface of the limb, or near it, beside a place on a joint's bone, so far along it and so far
/// from the vertex? Not where the vertex is clearly beyond the limb along the surface, and the way there much longer
/// than to the place: a flank that an arm touches, or goes into, may see the arm's bones, and a belly the thighs.
inline bool is_beside(const LimbRegions& regions, int joint, std::size_t vertex, core::Accumulator along,
                      core::Accumulator distance) {
    if (regions.bones.empty() || !(regions.bones[static_cast<std::size_t>(joint)].limb > 0)) return true;
    // Calibrated: with less of either, arms of more of 86 registered bodies are off level in the T-pose, found anew.
    constexpr core::Accumulator shared = 1.1; // of limbs: what armpits, groins and buttocks share with the trunk
    constexpr core::Accumulator longest = 4;  // of distances: ways over shoulders and buttocks are shorter
    const BoneOfLimb& bone = regions.bones[static_cast<std::size_t>(joint)];
    const core::Accumulator way = regions.from_end[vertex], place = bone.begin + along * (bone.end - bone.begin);
    return way <= shared * bone.limb || way <= place + longest * distance;
}

/// The nearest bones in sight of a vertex, of those that `is_candidate` names, given where on them, from 0 to 1, and
/// how far from the vertex the nearest place is: several where it is as near to them, as beside the joint where they
/// meet. Those behind several others are not looked for: they would hardly warm it.
template <typename Scalar, typename Candidate>
HeatSources<Scalar> nearest_bones_in_sight(const Vector3<Scalar>& vertex, const std::vector<Bone<Scalar>>& bones,
                                           const Body<Scalar>& body, const Candidate& is_candidate) {
    constexpr std::size_t looks = 6;
    constexpr Scalar as_near = Scalar(1.0001); // BP07
    struct Near {
        Scalar relative, distance;
        int joint;
        Vector3<Scalar> place;
    };
    std::vector<Near> candidates;
    for (const Bone<Scalar>& bone : bones) {
        const auto near = core::nearest_on_segment<Scalar, 3>(vertex, bone.from, bone.to);
        if (!is_candidate(bone.joint, near.along, near.distance)) continue;
        const Scalar radius = bone.radius_from + near.along * (bone.radius_to - bone.radius_from);
        const Vector3<Scalar> place = bone.from + near.along * (bone.to - bone.from);
        candidates.push_back({radius > 0 ? near.distance / radius : near.distance, near.distance, bone.joint, place});
    }
    const auto tried = static_cast<std::ptrdiff_t>(std::min(looks, candidates.size()));
    std::partial_sort(candidates.begin(), candidates.begin() + tried, candidates.end(),
                      [](const Near& a, const Near& b) { return a.relative < b.relative; });
    HeatSources<Scalar> out;
    Scalar nearest = 0;
    for (auto candidate = candidates.begin(); candidate != candidates.begin() + tried; ++candidate) {
        if (!out.joints.empty() && candidate->relative > as_near * nearest) break;
        if (!is_seen_from(candidate->place, vertex, body)) continue;
        if (out.joints.empty()) nearest = candidate->relative;
        out.distance = out.joints.empty() ? candidate->distance : std::min(out.distance, candidate->distance);
        out.joints.push_back(candidate->joint);
    }
    return out;
}

/// A limb's number, -1 for the trunk.
inline int limb_of(const TemplateJoint& joint) {
    const BodyPart part = part_of(joint.role);
    if (part == BodyPart::trunk) return -1;
    return (part == BodyPart::leg ? 2 : 0) + (joint.side == Side::right ? 1 : 0);
}

/// The limbs of a template, and the trunk's joints that carry them.
struct Limbs {
    static constexpr std::size_t count = 4;
    std::vector<int> limb;           ///< per joint, -1 for the trunk
    std::array<int, count> first{};  ///< each limb's joint nearest to the trunk
    std::array<int, count> parent{}; ///< the joint of the trunk that carries it

    explicit Limbs(const SkeletonTemplate& skeleton_template) {
        for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j) {
            limb.push_back(limb_of(skeleton_template.joints[j]));
            const int from = skeleton_template.joints[j].parent;
            if (limb.back() < 0 || from < 0 || limb[static_cast<std::size_t>(from)] >= 0) continue;
            first[static_cast<std::size_t>(limb.back())] = static_cast<int>(j);
            parent[static_cast<std::size_t>(limb.back())] = from;
        }
    }
};

} // namespace detail

/// That of a body (BP07 section 4): each vertex is heated by the bone that is nearest to it, as seen through the body,
/// the stronger the nearer. A trunk's bone is nearer than a limb's at the same distance: distances count relative to
/// how thick the body is around the bone. `bones` in the body's coordinates. A limb's bones heat no vertex of another
/// limb's region, and none that is much farther from the limb's end along the surface than they are, as the flank is
/// that an arm lies against; without `regions` every bone heats any. `joints`: more than any bone's. O(n joints) looks
/// through the body.
template <typename Scalar>
Heat heat_in(const Body<Scalar>& body, const std::vector<Bone<Scalar>>& bones, int joints,
             const LimbRegions& regions = {}) {
    using core::Accumulator;
    const Eigen::Index n = body.mesh.vertices.rows();
    const Eigen::VectorX<Accumulator> areas = core::vertex_areas(body.mesh);
    const Accumulator largest_supply = areas.sum() / core::rounding<Accumulator>(); // at no distance from a bone
    Heat out{surface_laplacian(body.mesh), Eigen::VectorX<Accumulator>::Zero(n),
             Eigen::MatrixX<Accumulator>::Zero(n, joints)};
    for (Eigen::Index v = 0; v < n; ++v) {
        const Vector3<Scalar> vertex = core::point(body.mesh.vertices, v);
        const auto at = static_cast<std::size_t>(v);
        const auto sources =
            detail::nearest_bones_in_sight(vertex, bones, body, [&](int joint, Scalar along, Scalar distance) {
                return detail::may_heat(regions, joint, at) && detail::is_beside(regions, joint, at, along, distance);
            });
        if (sources.joints.empty()) continue;
        const auto distance = static_cast<Accumulator>(sources.distance), squared = distance * distance;
        out.supply[v] = areas[v] < largest_supply * squared ? areas[v] / squared : largest_supply;
        for (const int joint : sources.joints)
            out.of_joint(v, joint) += out.supply[v] / static_cast<Accumulator>(sources.joints.size());
    }
    return out;
}

/// That of one surface in several poses, same faces and other places: for weights that are smooth, and near to the
/// bones, in all of them together. O(n joints).
inline Heat operator+(Heat heat, const Heat& other) {
    heat.conduction += other.conduction;
    heat.supply += other.supply;
    heat.of_joint += other.of_joint;
    return heat;
}

/// Weights as temperatures on a body: the heat spreads over the surface until it rests (BP07). One factorisation of a
/// sparse matrix, O(n^1.5). \returns a failure where no vertex sees a bone.
inline Outcome<JointWeights> heat_weights(const Heat& heat) {
    using core::Accumulator;
    if (!(heat.supply.maxCoeff() > 0))
        return Failure{Refusal::none, "the skeleton is not in the body: no bone is seen from the surface"};
    Eigen::SparseMatrix<Accumulator> matrix = heat.conduction;
    matrix.diagonal() += heat.supply;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Accumulator>> solver(matrix);
    if (solver.info() != Eigen::Success)
        throw Error(ErrorCode::internal, "the heat of the bones could not be solved for: a matrix is singular");
    const Eigen::MatrixX<Accumulator> temperatures = solver.solve(heat.of_joint);
    JointWeights weights = temperatures.cwiseMax(0);
    const Eigen::VectorX<Accumulator> sums = weights.rowwise().sum();
    weights.array().colwise() /= sums.array();
    return weights;
}

/// The weights with narrower bends: cubed, with rows that sum to 1 again. Where vertices follow two joints alike,
/// linear skinning draws them towards the joint: the narrower that is, the less volume a bent limb loses, and the more
/// its edges stretch (`with_bounded_stretch`). With cubes a forearm or calf bent by 90 degrees loses 2 to 5 % instead
/// of 13 % (24 registered bodies). O(n joints).
inline JointWeights concentrated(const JointWeights& weights) {
    const JointWeights cubes = weights.array().cube();
    const Eigen::VectorX<core::Accumulator> sums = cubes.rowwise().sum();
    return cubes.array().colwise() / sums.array();
}

/// The weights with narrower bends at elbows and knees: there the odds of following what is below the joint are
/// squared. What is above a hinge and what is below it is rigid, and the wider a bend, the more a limb that comes bent
/// bulges once it is straight, since skin that lay in the crease keeps its distance from the joint (`skinned`); what
/// bulges is lost when it bends again. Weights stay smooth, vertices follow the same joint most on each side of a
/// hinge, and rows sum to what they did. `weights` of concentrated heat. O(n joints).
inline JointWeights with_narrow_hinges(JointWeights weights, const SkeletonTemplate& skeleton_template) {
    for (int hinge = 0; hinge < static_cast<int>(skeleton_template.joints.size()); ++hinge) {
        const JointRole role = skeleton_template.joint(hinge).role;
        if (role != JointRole::elbow && role != JointRole::knee) continue;
        const std::vector<bool> is_below = joints_below(skeleton_template, hinge);
        for (Eigen::Index v = 0; v < weights.rows(); ++v) {
            const auto [below, above] = shares_of(weights, v, is_below);
            if (!(below > 0 && above > 0)) continue;
            divide_shares(weights, v, is_below, below * below / (below * below + above * above));
        }
    }
    return weights;
}

/// The weights with no vertex that follows two limbs: of the limbs that move a vertex the strongest does, by as much as
/// it is stronger than the next; what the others lose goes to the trunk where both limbs begin, as in the crotch and at
/// the neck, and to the strongest where surfaces of limbs have grown together. As smooth as they were but for the
/// latter. `least_to_trunk`: the part of it that goes to the trunk everywhere, 1 where a surface spans limbs, as a
/// skirt does. O(n joints).
inline JointWeights following_one_limb(JointWeights weights, const SkeletonTemplate& skeleton_template,
                                       core::Accumulator least_to_trunk = 0) {
    using core::Accumulator;
    using PerLimb = Eigen::Array<Accumulator, detail::Limbs::count, 1>;
    constexpr Accumulator clear_share = 4; // a quarter of the trunk is enough to give to it
    const detail::Limbs limbs(skeleton_template);
    const auto limb_at = [&](Eigen::Index j) { return limbs.limb[static_cast<std::size_t>(j)]; };
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
        PerLimb share = PerLimb::Zero();
        for (Eigen::Index j = 0; j < weights.cols(); ++j)
            if (limb_at(j) >= 0) share[limb_at(j)] += weights(v, j);
        int strongest = 0, next = 0;
        const Accumulator most = share.maxCoeff(&strongest), all = share.sum();
        PerLimb others = share;
        others[strongest] = 0;
        const Accumulator second = others.maxCoeff(&next);
        if (!(second > 0)) continue;

        const auto first_share = [&](int limb) {
            return weights(v, limbs.first[static_cast<std::size_t>(limb)]) / share[limb];
        };
        const Accumulator freed = all - (most - second);
        const Accumulator near_trunk = std::min({first_share(strongest), first_share(next), clear_share * (1 - all)});
        const Accumulator to_trunk = freed * std::clamp(near_trunk, least_to_trunk, Accumulator(1));
        const Accumulator kept = (most - second + freed - to_trunk) / most;
        for (Eigen::Index j = 0; j < weights.cols(); ++j)
            if (limb_at(j) >= 0) weights(v, j) *= limb_at(j) == strongest ? kept : 0;
        weights(v, limbs.parent[static_cast<std::size_t>(strongest)]) += to_trunk / 2;
        weights(v, limbs.parent[static_cast<std::size_t>(next)]) += to_trunk / 2;
    }
    return weights;
}

/// The weights with no vertex that follows most a joint which none of its neighbours follows most, as may be left where
/// the realms of several bones meet: it gets the mean of those of its neighbours that follow most what most of them do.
/// `faces` name the weights' rows. O(faces + n joints).
inline JointWeights without_islands(JointWeights weights, const Triangles& faces) {
    std::vector<int> strongest(static_cast<std::size_t>(weights.rows()));
    for (Eigen::Index v = 0; v < weights.rows(); ++v) weights.row(v).maxCoeff(&strongest[static_cast<std::size_t>(v)]);
    std::vector<bool> is_island(strongest.size(), true);
    const auto at = [](int v) { return static_cast<std::size_t>(v); };
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const std::size_t a = at(faces(f, k)), b = at(faces(f, (k + 1) % 3));
            if (strongest[a] == strongest[b]) is_island[a] = is_island[b] = false;
        }
    std::map<int, std::vector<int>> neighbours; // of the islands, those of an inner edge twice
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = faces(f, k);
            if (is_island[at(v)])
                neighbours[v].insert(neighbours[v].end(), {faces(f, (k + 1) % 3), faces(f, (k + 2) % 3)});
        }
    // One after the other: who has joined a neighbour stays with it, and so does the neighbour.
    for (const auto& [v, around] : neighbours) {
        const int own = strongest[at(v)]; // a lambda cannot hold what a binding names
        if (std::any_of(around.begin(), around.end(), [&](int w) { return strongest[at(w)] == own; })) continue;
        Eigen::RowVectorX<core::Accumulator> all = Eigen::RowVectorX<core::Accumulator>::Zero(weights.cols()),
                                             sum = all;
        for (const int w : around) all[strongest[at(w)]] += weights(w, strongest[at(w)]);
        all.maxCoeff(&strongest[at(v)]);
        int count = 0;
        for (const int w : around) {
            if (strongest[at(w)] != strongest[at(v)]) continue;
            sum += weights.row(w);
            ++count;
        }
        weights.row(v) = sum / static_cast<core::Accumulator>(count);
    }
    return weights;
}

} // namespace skelgen::applications
