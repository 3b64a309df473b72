#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/impl/balanced_bends.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/bounded_stretch.hpp>
#include <skelgen/applications/impl/deep_shoulders.hpp>
#include <skelgen/applications/impl/heat_weights.hpp>
#include <skelgen/applications/impl/kept_volumes.hpp>
#include <skelgen/applications/impl/limb_regions.hpp>
#include <skelgen/applications/impl/loose_pieces.hpp>
#include <skelgen/applications/impl/resting_surface.hpp>
#include <skelgen/applications/posing.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/nearest_share.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/weld.hpp>
#include <skelgen/symmetry/exact_mirror.hpp>

namespace skelgen::applications {

/// What stands for each vertex of an input on a body's surface: a place in one of its faces.
template <typename Scalar = double>
struct SurfacePlace {
    int face = -1;
    Vector3<Scalar> share = Vector3<Scalar>::Zero(); ///< of each of the face's corners; they sum to 1
    Scalar distance = 0;                             ///< from the vertex, in the body's coordinates
};

/// A pose that a body is bent from.
template <typename Scalar = double>
struct StartOfBends {
    std::vector<RigidMotion<Scalar>> motions; ///< what brings each joint to it
    Orientations<Scalar> axes;                ///< of each joint in it, as `bone_axes` has them
};

namespace detail {

template <typename Scalar>
int joints_inside(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton) {
    return static_cast<int>(
        std::count_if(skeleton.joints.begin(), skeleton.joints.end(), [&](const Joint<Scalar>& joint) {
            return surface::is_inside(body, body.similarity.to_canonical(joint.position));
        }));
}

/// The faces around each vertex of a mesh.
class FacesAround {
public:
    FacesAround(const Triangles& faces, Eigen::Index vertices) : begin_(static_cast<std::size_t>(vertices) + 1, 0) {
        for (Eigen::Index i = 0; i < faces.size(); ++i) ++begin_[static_cast<std::size_t>(faces.data()[i]) + 1];
        for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        faces_.resize(static_cast<std::size_t>(faces.size()));
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (int f = 0; f < faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) faces_[next[static_cast<std::size_t>(faces(f, k))]++] = f;
    }

    /// Calls `visit` with each of them.
    template <typename Visit>
    void of(int vertex, const Visit& visit) const {
        const auto v = static_cast<std::size_t>(vertex);
        for (std::size_t i = begin_[v]; i < begin_[v + 1]; ++i) visit(faces_[i]);
    }

private:
    std::vector<std::size_t> begin_; ///< per vertex of its first face in `faces_`
    std::vector<int> faces_;
};

/// How much of a bone that ends on the surface heats: a place there sees nothing of the body, or all, as rounding has
/// it.
template <typename Scalar>
inline constexpr Scalar heating_part = Scalar(0.9);

/// The heel's bone, which no joint ends: straight on from the calf, in the lower half of the foot. Without it what is
/// behind the ankle is as near to the calf as to the foot, which leads forward, and a heel would stay behind its sole.
/// None where the foot is no lower than the ankle.
template <typename Scalar>
std::optional<Bone<Scalar>> heel_of(const KinematicSkeleton<Scalar>& skeleton,
                                    const SkeletonTemplate& skeleton_template, int ankle) {
    const Joint<Scalar>& joint = skeleton.joints[static_cast<std::size_t>(ankle)];
    const Vector3<Scalar> foot = bone_end(skeleton, skeleton_template, ankle) - joint.position;
    const Vector3<Scalar> calf = joint.position - skeleton.joints[static_cast<std::size_t>(joint.parent)].position;
    if (!(foot.dot(calf) > 0)) return std::nullopt;
    const Vector3<Scalar> down = foot.dot(calf) / calf.squaredNorm() * calf;
    return Bone<Scalar>{ankle, joint.position + down / 2, joint.position + heating_part<Scalar> * down, joint.radius,
                        joint.radius};
}

/// The bones as what heats a body, in its coordinates: those that end on its surface somewhat shorter, and the heels'.
template <typename Scalar>
std::vector<Bone<Scalar>> heating_bones(const KinematicSkeleton<Scalar>& skeleton,
                                        const SkeletonTemplate& skeleton_template) {
    std::vector<Bone<Scalar>> bones = bones_of(skeleton, skeleton_template);
    for (Bone<Scalar>& bone : bones)
        if (ends_limb(skeleton_template.joint(bone.joint).role))
            bone.to = bone.from + heating_part<Scalar> * (bone.to - bone.from);
    for (int j = 0; j < static_cast<int>(skeleton.joints.size()); ++j)
        if (skeleton_template.joint(j).role == JointRole::ankle)
            if (const auto heel = heel_of(skeleton, skeleton_template, j)) bones.push_back(*heel);
    return bones;
}

/// The weights of a body's vertices from what warms it. \throws Error no_skeleton where no bone is seen.
inline JointWeights weights_from(const Heat& heat, const SkeletonTemplate& skeleton_template) {
    const Outcome<JointWeights> weights = heat_weights(heat);
    if (!weights) throw Error(ErrorCode::no_skeleton, weights.failure().what);
    return following_one_limb(with_narrow_hinges(concentrated(*weights), skeleton_template), skeleton_template);
}

template <typename Scalar>
StartOfBends<Scalar> t_pose(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template) {
    return {rest_motions<Scalar>(RestPose::t_pose, skeleton, skeleton_template,
                                 bone_orientations(skeleton, skeleton_template),
                                 Eigen::Quaternion<Scalar>(Eigen::Quaternion<Scalar>::Identity())),
            rest_axes<Scalar>(skeleton_template)};
}

/// The weights of the vertices of a body, whose skeleton is in its own coordinates: smooth as it is and at rest alike.
/// Skin is stretched outside of a bent joint and squeezed inside of it: weights that are smooth where it is bent alone
/// are not once it is straight. How far edges stretch is bounded at rest, where all bends begin: what lies squeezed in
/// the crease of a bent joint has to come apart there, or limbs bulge once they are straight.
template <typename Scalar>
JointWeights body_weights(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                          const SkeletonTemplate& skeleton_template, const LimbRegions& regions) {
    const auto heat_of = [&](const Body<Scalar>& pose, const KinematicSkeleton<Scalar>& bones) {
        return heat_in(pose, heating_bones(bones, skeleton_template), static_cast<int>(bones.joints.size()), regions);
    };
    const Heat as_is = heat_of(body, skeleton);
    const JointWeights first = weights_from(as_is, skeleton_template);

    const StartOfBends<Scalar> start = t_pose(skeleton, skeleton_template);
    const KinematicSkeleton<Scalar> bones_at_rest = moved(skeleton, skeleton_template, start.motions);
    const RestingSurface<Scalar> surface{body.mesh.vertices, start.motions, bones_at_rest, start.axes};
    Body<Scalar> rest = body;
    rest.mesh.vertices = at_rest(surface, first);
    rest.tree = surface::FaceTree<Scalar>(rest.mesh);
    JointWeights weights = weights_from(as_is + heat_of(rest, bones_at_rest), skeleton_template);
    weights = with_deep_shoulders(std::move(weights), body.mesh.vertices, skeleton, skeleton_template);
    const Triangles& faces = body.mesh.faces;
    weights = with_balanced_bends(std::move(weights), surface, faces, skeleton_template);
    weights = with_bounded_stretch(std::move(weights), surface, faces, skeleton_template, regions.of_joint);
    return without_islands(std::move(weights), faces);
}

/// The weights that were carried to a mesh, whose vertices may be split along seams, as its own edges want them: they
/// are others than those of the body, and so are the neighbours of each vertex. Where few rings of vertices make a
/// limb, as characters for games have them, those beside a bend say how much of it is lost.
template <typename Scalar>
JointWeights fitted_to_edges(JointWeights weights, const TriangleMesh<Scalar>& mesh,
                             const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                             const LimbRegions& regions, const StartOfBends<Scalar>& start) {
    constexpr core::Accumulator tolerated = 0.03; // what nobody sees; few and large faces would make others of it
    const auto welded = surface::weld(mesh, Scalar(0));
    JointWeights joined = JointWeights::Zero(welded.mesh.vertices.rows(), weights.cols());
    for (std::size_t v = 0; v < welded.placed.size(); ++v)
        if (welded.placed[v] >= 0) joined.row(welded.placed[v]) = weights.row(static_cast<Eigen::Index>(v));
    const Triangles& faces = welded.mesh.faces;
    const KinematicSkeleton<Scalar> at_rest = moved(skeleton, skeleton_template, start.motions);
    const RestingSurface<Scalar> surface{welded.mesh.vertices, start.motions, at_rest, start.axes};
    const auto bounded = [&](JointWeights of) {
        return with_bounded_stretch(std::move(of), surface, faces, skeleton_template, regions.of_joint);
    };
    const auto change = [&](const JointWeights& of) {
        return largest_bend_change(of, surface, faces, skeleton_template);
    };
    JointWeights balanced = bounded(with_balanced_bends(joined, surface, faces, skeleton_template, tolerated));
    joined = bounded(std::move(joined)); // which may undo what was balanced
    if (change(balanced) < change(joined)) joined = std::move(balanced);
    const auto restricted = [&](JointWeights of) { return without_islands(bounded(std::move(of)), faces); };
    joined = without_islands(std::move(joined), faces);
    joined = with_kept_volumes<Scalar>(std::move(joined), surface, faces, skeleton_template, restricted);
    for (std::size_t v = 0; v < welded.placed.size(); ++v)
        if (welded.placed[v] >= 0) weights.row(static_cast<Eigen::Index>(v)) = joined.row(welded.placed[v]);
    return weights;
}

/// The weights in the middle between those of each vertex and of its mirror image, where mesh and skeleton mirror
/// themselves.
template <typename Scalar>
JointWeights mirrored_evenly(JointWeights weights, const TriangleMesh<Scalar>& mesh,
                             const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template) {
    const auto mirror = symmetry::exact_mirror(mesh);
    const Scalar tolerance = static_cast<Scalar>(symmetry::mirror_tolerance) * core::bounding_diagonal(mesh.vertices);
    if (!mirror || !symmetry::is_mirrored(skeleton, skeleton_template, *mirror, tolerance)) return weights;
    JointWeights out = weights;
    for (Eigen::Index v = 0; v < weights.rows(); ++v)
        if (const int partner = mirror->partner[static_cast<std::size_t>(v)]; partner >= 0)
            for (int j = 0; j < weights.cols(); ++j) {
                const int other = counterpart(skeleton_template, j);
                out(v, j) = (weights(v, j) + weights(partner, other >= 0 ? other : j)) / 2;
            }
    return out;
}

} // namespace detail

/// The place on the body that stands for each vertex of the mesh that it was made of: the nearest one on the faces
/// around the vertex that stands for it (`standing_for`). \throws Error as that. O(n log n).
template <typename Scalar>
std::vector<SurfacePlace<Scalar>> places_on(const Body<Scalar>& body, const TriangleMesh<Scalar>& mesh) {
    const detail::FacesAround around(body.mesh.faces, body.mesh.vertices.rows());
    const std::vector<int> vertices = standing_for(body, mesh.vertices);
    std::vector<SurfacePlace<Scalar>> out(vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        const Vector3<Scalar> place =
            body.similarity.to_canonical(core::point(mesh.vertices, static_cast<Eigen::Index>(v)));
        Scalar least = std::numeric_limits<Scalar>::infinity();
        around.of(vertices[v], [&](int f) {
            Vector3<Scalar> corners[3];
            for (int k = 0; k < 3; ++k) corners[k] = core::point(body.mesh.vertices, body.mesh.faces(f, k));
            const Vector3<Scalar> share = core::nearest_share(place, corners[0], corners[1], corners[2]);
            const Scalar distance =
                (share[0] * corners[0] + share[1] * corners[1] + share[2] * corners[2] - place).norm();
            if (!(distance < least)) return;
            least = distance;
            out[v] = {f, share, distance};
        });
    }
    return out;
}

/// Binds a mesh to its skeleton: heat weights on the closed surface around all of its pieces, as it is and at rest
/// alike, carried over to each vertex from the place that stands for it, so that pieces move with what they lie on and
/// seams stay closed, and no edge of the mesh stretches too far (`with_bounded_stretch`). Where mesh and skeleton
/// mirror themselves, weights do. `skeleton` in the mesh's coordinates, `body` made of that mesh (`extract`), `start`
/// the pose that edges count from; an empty one: the T-pose. \throws Error no_skeleton where the skeleton does not lie
/// in the body; usage when it is not of that template, `start` has not as many joints, or the body was made of another
/// mesh.
template <typename Scalar>
Skin<Scalar> bind(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                  const SkeletonTemplate& skeleton_template, StartOfBends<Scalar> start = {}) {
    if (start.motions.empty() && start.axes.empty()) start = detail::t_pose(skeleton, skeleton_template);
    if (start.motions.size() != skeleton.joints.size() || start.axes.size() != skeleton.joints.size())
        throw Error(ErrorCode::usage, "the pose that bends start from must have as many joints as the skeleton");
    if (2 * detail::joints_inside(body, skeleton) <= static_cast<int>(skeleton.joints.size()))
        throw Error(ErrorCode::no_skeleton, "the skeleton does not lie in the mesh: take that which was found in it");
    const KinematicSkeleton<Scalar> of_body = surface::to_body(body, skeleton);
    const LimbRegions regions = limb_regions(body, of_body, skeleton_template);
    const JointWeights weights = detail::body_weights(body, of_body, skeleton_template, regions);

    JointWeights carried = JointWeights::Zero(mesh.vertices.rows(), weights.cols());
    std::vector<Scalar> gaps;
    const std::vector<SurfacePlace<Scalar>> places = places_on(body, mesh);
    for (Eigen::Index v = 0; v < carried.rows(); ++v) {
        const auto& [face, share, distance] = places[static_cast<std::size_t>(v)];
        for (int k = 0; k < 3; ++k)
            carried.row(v) += static_cast<core::Accumulator>(share[k]) * weights.row(body.mesh.faces(face, k));
        gaps.push_back(distance);
    }
    carried = with_loose_pieces(std::move(carried), mesh, body, gaps, of_body, skeleton_template);
    carried = following_one_limb(std::move(carried), skeleton_template);
    carried = detail::fitted_to_edges(std::move(carried), mesh, skeleton, skeleton_template, regions, start);
    carried = detail::mirrored_evenly(std::move(carried), mesh, skeleton, skeleton_template);
    return strongest_influences<Scalar>(carried.cast<Scalar>());
}

} // namespace skelgen::applications
