// The curve skeleton of anything, a body or not: its nodes and edges as OBJ, for any viewer.
//
//     curve_alone MESH CURVE.obj

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <vector>

#include <skelgen/skelgen.hpp>

int main(int argc, char** argv) try {
    if (argc < 3) {
        std::cerr << "usage: curve_alone MESH CURVE.obj\n";
        return EXIT_FAILURE;
    }
    const auto mesh = skelgen::read_mesh(argv[1]);
    const auto curve = skelgen::find_curve_skeleton(mesh); // in the mesh's own coordinates
    skelgen::write_curve(argv[2], curve);                  // or .json, .ply, .swc

    std::vector<int> degree(curve.regions.size(), 0);
    for (const auto& edge : curve.edges)
        for (const int node : edge) ++degree[static_cast<std::size_t>(node)];
    std::cout << curve.nodes.rows() << " nodes, " << curve.edges.size() << " edges, "
              << std::count(degree.begin(), degree.end(), 1) << " ends\n";

    // Each node knows the part of the surface that it stands for.
    const auto largest = std::max_element(curve.regions.begin(), curve.regions.end(),
                                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    std::cout << "the largest region has " << largest->size() << " of " << mesh.vertices.rows() << " vertices\n";
    return EXIT_SUCCESS;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
