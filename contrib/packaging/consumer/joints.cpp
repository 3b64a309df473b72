#include <iostream>

#include <skelgen/skelgen.hpp>

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto mesh = skelgen::read_mesh(argv[1]);
    const auto found = skelgen::extract(mesh);

    for (const auto& joint : found.skeleton.joints)
        std::cout << joint.name << ' ' << joint.position.transpose() << '\n';
}
