// The joints of a mesh that a program has as plain numbers: here read from an OFF file of triangles.
//
//     own_mesh MESH.off

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <skelgen/skelgen.hpp>

namespace {

/// Three coordinates a vertex, three vertices a face.
void read_numbers(const char* file, std::vector<double>& points, std::vector<int>& corners) {
    std::ifstream text(file);
    std::string off;
    std::size_t vertices = 0, faces = 0, edges = 0;
    text >> off >> vertices >> faces >> edges;
    points.resize(text ? 3 * vertices : 0);
    corners.resize(text ? 3 * faces : 0);
    for (double& number : points) text >> number;
    for (std::size_t i = 0, count = 0; i < corners.size(); text >> corners[i++])
        if (i % 3 == 0) text >> count;
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::cerr << "usage: own_mesh MESH.off\n";
        return static_cast<int>(skelgen::ErrorCode::usage);
    }
    std::vector<double> points;
    std::vector<int> corners;
    read_numbers(argv[1], points, corners);

    skelgen::TriangleMesh<double> mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(points.size() / 3), 3);
    mesh.faces.resize(static_cast<Eigen::Index>(corners.size() / 3), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
        mesh.vertices(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) = points[i];
    for (std::size_t i = 0; i < corners.size(); ++i)
        mesh.faces(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) = corners[i];

    const auto found = skelgen::extract(mesh);
    for (const auto& joint : found.skeleton.joints)
        std::cout << joint.name << ' ' << joint.position.transpose() << '\n';
    return EXIT_SUCCESS;
} catch (const skelgen::NoSkeleton& none) { // a mesh without a body: why, and what to do
    std::cerr << to_string(none.refusal()) << ": " << none.what() << '\n';
    return static_cast<int>(none.code());
} catch (const skelgen::Error& error) { // bad input or options
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
}
