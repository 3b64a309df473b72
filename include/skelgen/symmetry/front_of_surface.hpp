#pragma once

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::symmetry {

/// What feet and face show of a body's front: directions in the body's coordinates, each as long as it is clear,
/// and zero where nothing is shown.
template <typename Scalar = double>
struct SurfaceFront {
    Vector3<Scalar> sole = Vector3<Scalar>::Zero(); ///< sum over both feet: from the shin's axis to their middle, over
                                                    ///< their mean distance from it; at most 2
    Vector3<Scalar> face = Vector3<Scalar>::Zero(); ///< from the middle of the head's surface to that of its vertices,
                                                    ///< in diagonals of the body
};

/// `vertices`: where those of the input are, in its coordinates, each place once; none: those of the body, which tell
/// nothing of faces where an envelope stands for the input. O(n).
template <typename Scalar>
[[nodiscard]] SurfaceFront<Scalar>
front_of_surface(const Body<Scalar>& body, const refinement::RefinedJoints<Scalar>& joints,
                 const SkeletonTemplate& skeleton_template, const Points<Scalar>* vertices = nullptr);

} // namespace skelgen::symmetry

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/symmetry/impl/front_of_surface.hpp>
#endif
