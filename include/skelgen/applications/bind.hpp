#pragma once

#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/prepare.hpp>

namespace skelgen::applications {

/// The closed surface of a body that its skeleton lies in: the gentlest remedy's that holds all of its joints, or that
/// which holds most. `skeleton` in the mesh's coordinates. \returns a failure where none encloses half of them. \throws
/// Error as `surface::gather`.
template <typename Scalar>
[[nodiscard]] Outcome<Body<Scalar>> enclosing_body(const TriangleMesh<Scalar>& mesh,
                                                   const KinematicSkeleton<Scalar>& skeleton,
                                                   const surface::PrepareOptions& options = {});

/// What stands for each vertex of an input on a body's surface: a place in one of its faces.
template <typename Scalar = double>
struct SurfacePlace {
    int face = -1;
    Vector3<Scalar> share = Vector3<Scalar>::Zero(); ///< of each of the face's corners; they sum to 1
};

/// The place on the body that stands for each vertex of the mesh that it was made of: where the body has that very
/// vertex, there; else the nearest one on faces that look to the same side; for what was left out of the body the
/// nearest one. O(n log n).
template <typename Scalar>
[[nodiscard]] std::vector<SurfacePlace<Scalar>> places_on(const Body<Scalar>& body, const TriangleMesh<Scalar>& mesh);

/// Binds a mesh to its skeleton: heat weights on the closed surface around all of its pieces, carried over to each
/// vertex from the place that stands for it, so that pieces move with what they lie on and seams stay closed.
/// `skeleton` in the mesh's coordinates. \throws Error no_skeleton where the skeleton does not lie in the mesh; usage
/// when it is not of that template, or an option is out of its range; bad_input when `mesh` is no usable surface.
template <typename Scalar>
[[nodiscard]] Skin<Scalar> bind(const TriangleMesh<Scalar>& mesh, const KinematicSkeleton<Scalar>& skeleton,
                                const SkeletonTemplate& skeleton_template, const surface::PrepareOptions& options = {});

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/bind.hpp>
#endif
