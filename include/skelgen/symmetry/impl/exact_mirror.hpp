#pragma once

#include <skelgen/symmetry/exact_mirror.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>
#include <nanoflann.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/surface/weld.hpp>

namespace skelgen::symmetry {
namespace detail {

using MirrorPlaces = Eigen::Matrix<core::Accumulator, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Per place that which is at its mirror image; none where one has none, or two have the same.
template <typename Tree>
std::optional<std::vector<Eigen::Index>> mirror_partners(const MirrorPlaces& places, const Tree& tree,
                                                         const ExactMirror<core::Accumulator>& mirror,
                                                         core::Accumulator tolerance) {
    std::vector<Eigen::Index> out(static_cast<std::size_t>(places.rows()));
    for (Eigen::Index i = 0; i < places.rows(); ++i) {
        const Vector3<core::Accumulator> image = mirror(places.row(i).transpose());
        core::Accumulator squared = 0;
        nanoflann::KNNResultSet<core::Accumulator, Eigen::Index> result(1);
        result.init(&out[static_cast<std::size_t>(i)], &squared);
        tree.index->findNeighbors(result, image.data(), nanoflann::SearchParams());
        if (!(squared <= tolerance * tolerance)) return std::nullopt;
    }
    for (std::size_t i = 0; i < out.size(); ++i)
        if (out[static_cast<std::size_t>(out[i])] != static_cast<Eigen::Index>(i)) return std::nullopt;
    return out;
}

/// The joint of the other side, or the joint itself where it has no side.
inline int mirrored_joint(const SkeletonTemplate& skeleton_template, int joint) {
    const int other = counterpart(skeleton_template, joint);
    return other >= 0 ? other : joint;
}

template <typename Scalar>
void require_of_template(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template) {
    if (skeleton.joints.size() != skeleton_template.joints.size())
        throw Error(ErrorCode::usage, "the skeleton is not of this template");
}

} // namespace detail

template <typename Scalar>
std::optional<ExactMirror<Scalar>> exact_mirror(const TriangleMesh<Scalar>& mesh) {
    using detail::MirrorPlaces;
    const surface::WeldedMesh<Scalar> welded = surface::weld(mesh, Scalar(0)); // seams may split one side alone
    const MirrorPlaces places = welded.mesh.vertices.template cast<core::Accumulator>();
    if (places.rows() == 0) return std::nullopt;
    const Vector3<core::Accumulator> middle = places.colwise().mean().transpose();
    const MirrorPlaces from_middle = places.rowwise() - middle.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<core::Accumulator, 3, 3>> axes(from_middle.transpose() *
                                                                                     from_middle);
    const core::Accumulator tolerance =
        mirror_tolerance * (places.colwise().maxCoeff() - places.colwise().minCoeff()).norm();
    // Nearly all meshes reach farther to one side than to the other: no tree for these.
    std::vector<Vector3<core::Accumulator>> normals;
    for (int k = 2; k >= 0; --k) {
        const Vector3<core::Accumulator> normal = axes.eigenvectors().col(k);
        const auto along = (from_middle * normal).eval();
        if (std::abs(along.maxCoeff() + along.minCoeff()) <= tolerance) normals.push_back(normal);
    }
    if (normals.empty()) return std::nullopt;
    const nanoflann::KDTreeEigenMatrixAdaptor<MirrorPlaces, 3, nanoflann::metric_L2_Simple> tree(3, places);
    for (const Vector3<core::Accumulator>& normal : normals) {
        const auto partners = detail::mirror_partners(places, tree, {normal, normal.dot(middle), {}}, tolerance);
        if (!partners) continue;
        std::vector<int> first(partners->size(), -1);
        for (std::size_t v = welded.placed.size(); v-- > 0;)
            if (welded.placed[v] >= 0) first[static_cast<std::size_t>(welded.placed[v])] = static_cast<int>(v);
        ExactMirror<Scalar> out{normal.template cast<Scalar>(), static_cast<Scalar>(normal.dot(middle)), {}};
        for (const int place : welded.placed)
            out.partner.push_back(
                place < 0 ? -1 : first[static_cast<std::size_t>((*partners)[static_cast<std::size_t>(place)])]);
        return out;
    }
    return std::nullopt;
}

template <typename Scalar>
bool is_mirrored(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                 const ExactMirror<Scalar>& mirror, Scalar tolerance) {
    detail::require_of_template(skeleton, skeleton_template);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Joint<Scalar>& joint = skeleton.joints[j];
        const Joint<Scalar>& other =
            skeleton.joints[static_cast<std::size_t>(detail::mirrored_joint(skeleton_template, static_cast<int>(j)))];
        if (joint.is_present && other.is_present && !((joint.position - mirror(other.position)).norm() <= tolerance))
            return false;
    }
    return true;
}

template <typename Scalar>
KinematicSkeleton<Scalar> mirrored_evenly(KinematicSkeleton<Scalar> skeleton, const SkeletonTemplate& skeleton_template,
                                          const ExactMirror<Scalar>& mirror, Scalar size) {
    const Scalar near = Scalar(0.1) * size; // joints farther apart are not the same one, found twice
    const Scalar least_cosine = Scalar(0.9);
    const Scalar along = mirror.normal.dot(skeleton.frame.left);
    if (!(std::abs(along) >= least_cosine) || !is_mirrored(skeleton, skeleton_template, mirror, near)) return skeleton;

    const KinematicSkeleton<Scalar> was = skeleton;
    const auto end_of = [&](const SkeletonTemplate& of, int j) {
        const std::string name = end_point_name(of, of.joint(j));
        return std::find_if(was.end_points.begin(), was.end_points.end(),
                            [&](const auto& end) { return end.first == name; });
    };
    for (std::size_t j = 0; j < was.joints.size(); ++j) {
        const int k = detail::mirrored_joint(skeleton_template, static_cast<int>(j));
        const Joint<Scalar>& own = was.joints[j];
        const Joint<Scalar>& other = was.joints[static_cast<std::size_t>(k)];
        // What each side says, or the one that was found.
        const Scalar share = own.is_present == other.is_present ? Scalar(0.5) : own.is_present ? Scalar(1) : Scalar(0);
        const auto both = [&]<typename T>(const T& mine, const T& its) -> T {
            return share * mine + (1 - share) * its;
        };
        Joint<Scalar>& joint = skeleton.joints[j];
        joint.position = both(own.position, mirror(other.position));
        joint.radius = both(own.radius, other.radius);
        joint.confidence =
            static_cast<double>(share) * own.confidence + static_cast<double>(1 - share) * other.confidence;
        joint.is_present = own.is_present || other.is_present;
        if (!ends_limb(skeleton_template.joint(static_cast<int>(j)).role)) continue;
        const auto mine = end_of(skeleton_template, static_cast<int>(j)), its = end_of(skeleton_template, k);
        if (mine != was.end_points.end() && its != was.end_points.end())
            skeleton.end_points[static_cast<std::size_t>(mine - was.end_points.begin())].second =
                both(mine->second, mirror(its->second));
    }
    BodyFrame<Scalar>& frame = skeleton.frame;
    frame.origin = skeleton.joints.front().position;
    frame.left = along > 0 ? mirror.normal : Vector3<Scalar>(-mirror.normal);
    frame.up = (frame.up - frame.up.dot(frame.left) * frame.left).normalized();
    frame.forward = frame.left.cross(frame.up);
    return skeleton;
}

} // namespace skelgen::symmetry
