#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <array>
#include <exception>
#include <optional>

#include <skelgen/core/error.hpp>

#include "cgal_mesh.hpp"
#include "damages.hpp"
#include "plate.hpp"

namespace skelgen::damage {
namespace {

/// The union, which takes both; none where the surfaces cross themselves at their intersection.
std::optional<Mesh> united(CgalMesh a, CgalMesh b) {
    CgalMesh both;
    try {
        if (!CGAL::Polygon_mesh_processing::corefine_and_compute_union(a, b, both)) return std::nullopt;
    } catch (const std::exception&) { // CGAL's triangulation of a face in which intersections cross
        return std::nullopt;
    }
    return from_cgal(both);
}

} // namespace

Mesh plate_grown(const Subject& subject) {
    // Heights that the soles sink in: deeper where toes cross each other.
    constexpr std::array<double, 8> depths{0.005, 0.0075, 0.01, 0.015, 0.02, 0.025, 0.03, 0.04};
    const CgalMesh body = to_cgal(subject.mesh);
    if (!CGAL::is_closed(body))
        throw Error(ErrorCode::bad_input, "the surface has a boundary: no plate can be grown to it");
    for (const double depth : depths)
        if (auto mesh = united(body, to_cgal(plate_below(subject.mesh, *subject.skeleton, -depth)))) return *mesh;
    throw Error(ErrorCode::bad_input, "the soles cross themselves: no plate can be grown to them");
}

} // namespace skelgen::damage
