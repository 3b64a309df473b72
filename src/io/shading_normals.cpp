#include "shading_normals.hpp"

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/weld.hpp>

namespace skelgen::io::detail {

Points<double> shading_normals(const TriangleMesh<double>& mesh) {
    constexpr double smooth = 0.5; // cosine of 60 degrees
    const auto welded = surface::weld(mesh, 0.0);
    const Points<double> shared = core::vertex_normals(welded.mesh);
    Points<double> normals = core::vertex_normals(mesh);
    for (Eigen::Index v = 0; v < normals.rows(); ++v) {
        const int place = welded.placed[static_cast<std::size_t>(v)];
        if (place >= 0 && (normals.row(v).isZero() || normals.row(v).dot(shared.row(place)) > smooth))
            normals.row(v) = shared.row(place);
        if (normals.row(v).isZero()) normals.row(v) = Eigen::RowVector3d::UnitY();
    }
    return normals;
}

} // namespace skelgen::io::detail
