#include "cgal_mesh.hpp"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

namespace skelgen::damage {

CgalMesh to_cgal(const Mesh& mesh) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    const Soup soup = to_soup(mesh);
    std::vector<Kernel::Point_3> points;
    for (const Vec3& p : soup.vertices) points.emplace_back(p.x(), p.y(), p.z());
    std::vector<std::array<std::size_t, 3>> polygons;
    for (const Face& face : soup.faces)
        polygons.push_back(
            {static_cast<std::size_t>(face[0]), static_cast<std::size_t>(face[1]), static_cast<std::size_t>(face[2])});
    pmp::orient_polygon_soup(points, polygons);
    CgalMesh out;
    pmp::polygon_soup_to_polygon_mesh(points, polygons, out);
    return out;
}

Mesh from_cgal(const CgalMesh& mesh) {
    Soup soup;
    std::vector<int> index(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
    for (const auto v : mesh.vertices()) {
        const Kernel::Point_3& p = mesh.point(v);
        index[v.idx()] = soup.add({p.x(), p.y(), p.z()});
    }
    for (const auto f : mesh.faces()) {
        Face face{};
        std::size_t k = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) face[k++] = index[v.idx()];
        soup.faces.push_back(face);
    }
    return to_compact_mesh(soup);
}

} // namespace skelgen::damage
