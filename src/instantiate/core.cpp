// What every stage shares, compiled once for each scalar.

#include <skelgen/core/impl/builtin_templates.hpp>
#include <skelgen/core/impl/curve_graph.hpp>
#include <skelgen/core/impl/geodesics.hpp>
#include <skelgen/core/impl/geometry.hpp>
#include <skelgen/core/impl/line.hpp>
#include <skelgen/core/impl/template_rules.hpp>

namespace skelgen::core {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template Points<Scalar> vertex_normals(const TriangleMesh<Scalar>&);                                               \
    template FittedLine<Scalar> principal_line(const std::vector<Vector3<Scalar>>&);                                   \
    template Scalar winding_number(const TriangleMesh<Scalar>&, const Vector3<Scalar>&);                               \
    template int nearest_point(const Points<Scalar>&, const Vector3<Scalar>&);                                         \
    template int nearest_vertex(const TriangleMesh<Scalar>&, const Vector3<Scalar>&);                                  \
    template ShortestPaths<Scalar> shortest_paths(const CurveGraph<Scalar>&, int, Scalar);                             \
    template ShortestPaths<Scalar> shortest_paths(const SurfaceGraph<Scalar>&, int, Scalar);                           \
    template std::vector<Scalar> distances_from(const SurfaceGraph<Scalar>&, const std::vector<int>&);                 \
    template std::vector<int> nearest_source(const SurfaceGraph<Scalar>&, const std::vector<Source<Scalar>>&);         \
    template std::vector<int> nearest_source(const CurveGraph<Scalar>&, const std::vector<Source<Scalar>>&);           \
    template Scalar curve_diameter(const CurveGraph<Scalar>&);                                                         \
    template SurfaceGraph<Scalar> surface_graph(const TriangleMesh<Scalar>&, const Triangles&);                        \
    template Scalar geodesic_diameter(const SurfaceGraph<Scalar>&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::core
