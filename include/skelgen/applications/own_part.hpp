#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// What of a mesh belongs to one of several bodies in it, by numbers in the mesh, rising.
struct OwnPart {
    std::vector<int> faces, vertices;
    bool is_all = true; ///< then both are empty
};

/// A body with what of the mesh belongs to it.
template <typename Scalar = double>
struct OwnBody {
    TriangleMesh<Scalar> mesh; ///< of that alone
    Body<Scalar> body;         ///< `source` and `nearest` are of this mesh
    OwnPart part;              ///< where it was
};

/// A body and the mesh that it was found in, without other bodies that stand apart from it: of those that
/// `surface::faces_of_body` tells apart, the one stays which most of the body's own vertices are on. Both come back as
/// they are where there is one alone. O(n log n) for each body.
template <typename Scalar>
[[nodiscard]] OwnBody<Scalar> own_body(TriangleMesh<Scalar> mesh, Body<Scalar> body);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/own_part.hpp>
#endif
