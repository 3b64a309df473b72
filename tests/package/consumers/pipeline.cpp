// A user's program: it prints every bit of the skeleton that it finds in an OFF file. Linked against skelgen::skelgen,
// or header-only against skelgen::core, which reads no files: so the few lines that read one are here.

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/extract.hpp>

namespace {

skelgen::TriangleMesh<double> read_off(const char* path) {
    std::ifstream file(path);
    std::string keyword;
    Eigen::Index vertices = 0, faces = 0, edges = 0;
    file >> keyword >> vertices >> faces >> edges;
    skelgen::TriangleMesh<double> mesh{skelgen::Points<double>(vertices, 3), skelgen::Triangles(faces, 3)};
    for (Eigen::Index v = 0; v < vertices; ++v)
        file >> mesh.vertices(v, 0) >> mesh.vertices(v, 1) >> mesh.vertices(v, 2);
    for (Eigen::Index f = 0; f < faces; ++f) {
        int corners = 0;
        file >> corners >> mesh.faces(f, 0) >> mesh.faces(f, 1) >> mesh.faces(f, 2);
    }
    if (!file) throw skelgen::Error(skelgen::ErrorCode::bad_input, std::string(path) + ": is no OFF file of triangles");
    return mesh;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return EXIT_FAILURE;
    try {
        const auto found = skelgen::extract_skeleton(read_off(argv[1]));
        for (const auto& joint : found.skeleton.joints)
            std::printf("%s %a %a %a %a %a\n", joint.name.c_str(), joint.position.x(), joint.position.y(),
                        joint.position.z(), joint.radius, joint.confidence);
        std::printf("%zu nodes, diameter %a\n", found.curve.regions.size(), found.geodesic_diameter);
        return found.skeleton.joints.size() == 21 ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const skelgen::Error& error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
