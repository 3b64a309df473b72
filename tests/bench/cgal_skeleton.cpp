#include "cgal_skeleton.hpp"

#include <array>
#include <vector>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/extract_mean_curvature_flow_skeleton.h>

namespace skelgen::bench {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;

} // namespace

struct CgalSkeletonizer::Mesh {
    SurfaceMesh surface;
};

CgalSkeletonizer::CgalSkeletonizer(const TriangleMesh<double>& mesh) : mesh_(std::make_unique<Mesh>()) {
    std::vector<Point> points;
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
        points.emplace_back(mesh.vertices(i, 0), mesh.vertices(i, 1), mesh.vertices(i, 2));
    std::vector<std::array<std::size_t, 3>> faces;
    for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i)
        faces.push_back({static_cast<std::size_t>(mesh.faces(i, 0)), static_cast<std::size_t>(mesh.faces(i, 1)),
                         static_cast<std::size_t>(mesh.faces(i, 2))});
    CGAL::Polygon_mesh_processing::orient_polygon_soup(points, faces);
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, faces, mesh_->surface);
}

CgalSkeletonizer::~CgalSkeletonizer() = default;

bool CgalSkeletonizer::is_closed() const { return CGAL::is_closed(mesh_->surface); }

std::size_t CgalSkeletonizer::run() const {
    CGAL::Mean_curvature_flow_skeletonization<SurfaceMesh>::Skeleton skeleton;
    CGAL::extract_mean_curvature_flow_skeleton(mesh_->surface, skeleton);
    return boost::num_vertices(skeleton);
}

std::size_t read_by_cgal(const std::filesystem::path& file) {
    SurfaceMesh surface;
    return CGAL::IO::read_polygon_mesh(file.string(), surface) ? surface.number_of_faces() : 0;
}

} // namespace skelgen::bench
