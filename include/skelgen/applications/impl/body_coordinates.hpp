#pragma once

#include <skelgen/applications/body_coordinates.hpp>

#include <cstddef>

#include <nanoflann.hpp>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {

template <typename Scalar>
std::vector<int> standing_for(const Body<Scalar>& body, const Points<Scalar>& input) {
    std::vector<int> out(static_cast<std::size_t>(input.rows()), -1);
    if (body.nearest.size() > out.size())
        throw Error(ErrorCode::usage, "the body was not made of this mesh: it names more vertices");
    for (std::size_t v = body.source.size(); v-- > 0;) {
        if (body.source[v] < 0) continue;
        if (static_cast<std::size_t>(body.source[v]) >= out.size())
            throw Error(ErrorCode::usage, "the body was not made of this mesh: it names more vertices");
        out[static_cast<std::size_t>(body.source[v])] = static_cast<int>(v);
    }
    for (std::size_t v = 0; v < body.nearest.size(); ++v)
        if (body.nearest[v] >= 0) out[v] = body.nearest[v];
    const nanoflann::KDTreeEigenMatrixAdaptor<Points<Scalar>, 3, nanoflann::metric_L2_Simple> tree(3,
                                                                                                   body.mesh.vertices);
    for (std::size_t v = 0; v < out.size(); ++v) {
        if (out[v] >= 0) continue;
        const Vector3<Scalar> place = body.similarity.to_canonical(core::point(input, static_cast<Eigen::Index>(v)));
        Eigen::Index found = 0;
        Scalar squared = 0;
        nanoflann::KNNResultSet<Scalar, Eigen::Index> result(1);
        result.init(&found, &squared);
        tree.index->findNeighbors(result, place.data(), nanoflann::SearchParams());
        out[v] = static_cast<int>(found);
    }
    return out;
}

template <typename Scalar>
std::vector<int> vertices_of_input(const Body<Scalar>& body, const TriangleMesh<Scalar>& input) {
    std::vector<int> out = first_standing(body, standing_for(body, input.vertices));
    for (std::size_t v = 0; v < out.size(); ++v)
        if (out[v] < 0)
            out[v] = core::nearest_vertex(
                input, body.similarity.to_input(core::point(body.mesh.vertices, static_cast<Eigen::Index>(v))));
    return out;
}

template <typename Scalar>
Vector3<Scalar> joint_place(const KinematicSkeleton<Scalar>& skeleton, const std::string& name) {
    const int joint = find_joint(skeleton, name);
    if (joint < 0)
        throw Error(ErrorCode::usage,
                    "the skeleton has no joint '" + name + "'; take template human21, of an animal quadruped");
    return skeleton.joints[static_cast<std::size_t>(joint)].position;
}

template <typename Scalar>
const SkeletonTemplate& own_template(const KinematicSkeleton<Scalar>& skeleton) {
    return builtin_template(skeleton.template_name == "quadruped" ? "quadruped" : "human21");
}

template <typename Scalar>
Vector3<Scalar> joint_place(const KinematicSkeleton<Scalar>& skeleton, JointRole role, Side side) {
    const SkeletonTemplate& own = own_template(skeleton);
    return joint_place(skeleton, own.joint(find_joint(own, role, side)).name);
}

template <typename Scalar>
Vector3<Scalar> end_place(const KinematicSkeleton<Scalar>& skeleton, const std::string& name,
                          const std::string& instead) {
    for (const auto& [end, place] : skeleton.end_points)
        if (end == name) return place;
    return joint_place(skeleton, instead);
}

} // namespace skelgen::applications
