// A mesh that is already in CGAL's hands. CGAL::Surface_mesh is under the GPL (or CGAL's commercial licence), and so is
// a program that includes it, as this one does; skelgen itself is not.
//
//     cgal MESH.off

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <skelgen/io/cgal_adaptor.hpp>
#include <skelgen/skelgen.hpp>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>; // any kernel's Point_3

int main(int argc, char** argv) try {
    Mesh mesh;
    if (argc < 2 || !CGAL::IO::read_OFF(argv[1], mesh)) {
        std::cerr << "usage: cgal MESH.off\n";
        return EXIT_FAILURE;
    }
    const auto found = skelgen::extract_skeleton(skelgen::to_triangle_mesh(mesh));
    for (const auto& joint : found.skeleton.joints)
        std::cout << joint.name << ' ' << joint.position.transpose() << '\n';

    // Results on the surface index the mesh's own vertices: each gets the curve's node that it belongs to.
    auto node_of = mesh.add_property_map<Mesh::Vertex_index, int>("v:node", -1).first;
    for (std::size_t node = 0; node < found.curve.regions.size(); ++node)
        for (const int vertex : found.curve.regions[node])
            node_of[Mesh::Vertex_index(static_cast<Mesh::size_type>(vertex))] = static_cast<int>(node);
    int without = 0;
    for (const auto vertex : mesh.vertices()) without += node_of[vertex] < 0 ? 1 : 0;
    std::cout << mesh.number_of_vertices() << " vertices, " << without << " without a node\n";
    return EXIT_SUCCESS;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
