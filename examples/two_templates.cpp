// Two templates in one body: the surface is prepared and its curve found once, then each template is fitted to them.
//
//     two_templates MESH

#include <cstdlib>
#include <exception>
#include <iostream>

#include <skelgen/skelgen.hpp>

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::cerr << "usage: two_templates MESH\n";
        return EXIT_FAILURE;
    }
    const auto mesh = skelgen::read_mesh(argv[1]);
    const auto body = skelgen::prepare(mesh);     // one manifold surface of unit area
    const auto curve = skelgen::find_curve(body); // takes most of the time

    for (const char* name : {"human21", "pinocchio18"}) {
        const auto found = skelgen::skeleton_of(body, curve, skelgen::builtin_template(name));
        if (!found) { // to be expected of some meshes, and so no exception
            std::cerr << name << ": " << found.failure().what << '\n';
            return EXIT_FAILURE;
        }
        std::cout << name << ": " << found->skeleton.joints.size() << " joints\n";
        const auto skeleton = skelgen::surface::to_input(body, found->skeleton); // in the mesh's coordinates
        for (const auto& joint : skeleton.joints)
            std::cout << "  " << joint.name << ' ' << joint.position.transpose() << '\n';
    }
    return EXIT_SUCCESS;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
