#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "soup.hpp"

namespace skelgen::damage {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Vertices where several fans of faces touch become one for each fan.
/// \throws Error bad_input when more than two faces share an edge.
[[nodiscard]] CgalMesh to_cgal(const Mesh& mesh);

[[nodiscard]] Mesh from_cgal(const CgalMesh& mesh);

} // namespace skelgen::damage
