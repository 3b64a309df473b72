#pragma once

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// The faces of the mesh that a body was made of, looking outwards: as they are, or all turned over where the mesh is
/// inside out, which programs that leave out what looks away would show as its far side. Inside out is what encloses at
/// least half of the body's volume with the other sign: a shell turned inwards on purpose, as an outline around a
/// drawn figure, is not. Each face keeps its first corner. O(faces).
template <typename Scalar>
[[nodiscard]] Triangles outward_faces(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/outward_faces.hpp>
#endif
