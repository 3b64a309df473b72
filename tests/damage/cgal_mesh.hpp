#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "soup.hpp"

namespace skelgen::damage {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Where several fans of faces touch in a vertex, or more than two in an edge, it becomes one for each.
[[nodiscard]] CgalMesh to_cgal(const Mesh& mesh);

[[nodiscard]] Mesh from_cgal(const CgalMesh& mesh);

} // namespace skelgen::damage
