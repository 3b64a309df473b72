#pragma once

#include <string>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// For each vertex of the input (n x 3, in its own coordinates) the vertex of the body that stands for it. It is the
/// one at the same place, else the one that the body names, else the nearest. \throws Error usage when the body was
/// made of another number of vertices. O(n log n).
template <typename Scalar>
[[nodiscard]] std::vector<int> standing_for(const Body<Scalar>& body, const Points<Scalar>& input);

/// For each vertex of the body the first one of the input that it stands for, -1 where there is none. `stands_for`: as
/// `standing_for` has it. O(n).
template <typename Scalar>
[[nodiscard]] std::vector<int> first_standing(const Body<Scalar>& body, const std::vector<int>& stands_for) {
    std::vector<int> out(static_cast<std::size_t>(body.mesh.vertices.rows()), -1);
    for (std::size_t v = stands_for.size(); v-- > 0;)
        out[static_cast<std::size_t>(stands_for[v])] = static_cast<int>(v);
    return out;
}

/// For each vertex of the body one of the input that is at its place, or the nearest where the body has vertices of its
/// own. `input`: the mesh that the body was made of. \throws Error as `standing_for`. O(n log n), and O(n) for each
/// vertex of the body's own.
template <typename Scalar>
[[nodiscard]] std::vector<int> vertices_of_input(const Body<Scalar>& body, const TriangleMesh<Scalar>& input);

/// The built-in template that a skeleton is of: `quadruped` an animal's, human21 all others'. O(1).
template <typename Scalar>
[[nodiscard]] const SkeletonTemplate& own_template(const KinematicSkeleton<Scalar>& skeleton);

/// Place of the first joint of a role and side in the skeleton's own template. \throws Error usage when the skeleton
/// has no joint of its name.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> joint_place(const KinematicSkeleton<Scalar>& skeleton, JointRole role,
                                          Side side = Side::none);

/// Place of a joint. \throws Error usage when the skeleton has no joint of that name.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> joint_place(const KinematicSkeleton<Scalar>& skeleton, const std::string& name);

/// Place of an end point; where it is not known, of the joint `instead`. \throws Error usage as `joint_place`.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> end_place(const KinematicSkeleton<Scalar>& skeleton, const std::string& name,
                                        const std::string& instead);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/body_coordinates.hpp>
#endif
