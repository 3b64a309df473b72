// The skeleton of the body in a mesh file: its joints as text, and all that was found as JSON.
//
//     extract MESH [SKELETON.json]

#include <cstdlib>
#include <iostream>

#include <skelgen/skelgen.hpp>

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::cerr << "usage: extract MESH [SKELETON.json]\n";
        return static_cast<int>(skelgen::ErrorCode::usage);
    }
    const auto mesh = skelgen::read_mesh(argv[1]); // OFF, OBJ, PLY, STL, GLB, glTF, VRM, FBX or DAE
    const auto found = skelgen::extract(mesh);

    for (const auto& joint : found.skeleton.joints)
        std::cout << joint.name << ' ' << joint.position.transpose() << '\n';
    std::cout << "up " << found.skeleton.frame.up.transpose() << '\n'
              << "the sides are right with a confidence of " << found.skeleton.quality.sides_confidence << '\n'
              << found.skeleton.joints.size() << " joints in " << found.timings.total << " ms\n";
    for (const auto& warning : found.skeleton.quality.warnings) std::cout << "warning: " << warning << '\n';

    if (argc > 2) skelgen::write_skeleton(argv[2], found.skeleton);
    return EXIT_SUCCESS;
} catch (const skelgen::Error& error) { // a file that cannot be read, a mesh without a body
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
}
