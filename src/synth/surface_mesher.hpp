#pragma once

#include <functional>

#include <skelgen/core/mesh.hpp>

#include "primitives.hpp"

namespace skelgen::synth {

/// A closed surface as the zero set of a field, and how finely to mesh it.
struct ImplicitSurface {
    std::function<double(const Vec3&)> field; ///< negative inside
    std::function<double(const Vec3&)> grain; ///< relative edge length around a point
    Vec3 inside = Vec3::Zero();               ///< a point with field < 0
    double radius = 1;                        ///< the surface lies within this distance of `inside`
};

/// How a mesh hangs together.
struct Topology {
    bool closed_manifold = false; ///< every edge joins two faces that run along it in opposite directions
    int components = 0;           ///< connected by edges; unused vertices count
    int euler = 0;                ///< vertices - edges + faces: 2 for a closed body without handles
};

/// O(faces log faces).
[[nodiscard]] Topology topology_of(const TriangleMesh<double>& mesh);

/// A closed manifold mesh with `faces` triangles within 2 %, outward, its vertices on the surface, edges in proportion
/// to the grain. Delaunay refinement (CGAL's surface mesher), then edge collapses (fewer faces) or subdivision (more).
/// The same surface gives the same bytes.
/// \param one_body refine until the mesh is one closed piece without handles
/// \throws Error internal when no such mesh comes out, as where parts of the surface just touch: after a bounded
/// number of looks at the field.
[[nodiscard]] TriangleMesh<double> mesh_surface(const ImplicitSurface& surface, int faces, bool one_body);

} // namespace skelgen::synth
