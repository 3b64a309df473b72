// A mesh that is already in OpenMesh's hands: no file in between, and vertex indices stay the handles' own.
//
//     openmesh MESH

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <skelgen/io/openmesh_adaptor.hpp>
#include <skelgen/skelgen.hpp>

using Mesh = OpenMesh::TriMesh_ArrayKernelT<>; // with float points; others serve as well

int main(int argc, char** argv) try {
    Mesh mesh;
    if (argc < 2 || !OpenMesh::IO::read_mesh(mesh, argv[1])) {
        std::cerr << "usage: openmesh MESH\n";
        return EXIT_FAILURE;
    }
    const auto found = skelgen::extract_skeleton(skelgen::to_triangle_mesh(mesh));
    for (const auto& joint : found.skeleton.joints)
        std::cout << joint.name << ' ' << joint.position.transpose() << '\n';

    // What belongs to the end of the curve that lies in a hand, say, is named by vertices of the OpenMesh mesh.
    mesh.request_vertex_status();
    const auto& hand = found.skeleton.joints[static_cast<std::size_t>(find_joint(found.skeleton, "left_hand"))];
    const int node = skelgen::core::nearest_node(found.curve, hand.position);
    for (const int vertex : found.curve.regions[static_cast<std::size_t>(node)])
        mesh.status(Mesh::VertexHandle(vertex)).set_selected(true);
    int selected = 0;
    for (const auto vertex : mesh.vertices()) selected += mesh.status(vertex).selected() ? 1 : 0;
    std::cout << "selected " << selected << " of " << mesh.n_vertices() << " vertices, around the left hand\n";
    return EXIT_SUCCESS;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
