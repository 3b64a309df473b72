// A body bound to its skeleton, in the T-pose, as a character that engines load.
//
//     rig MESH CHARACTER.vrm

#include <cstdlib>
#include <iostream>

#include <skelgen/applications/rig.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/skelgen.hpp>

int main(int argc, char** argv) try {
    if (argc < 3) {
        std::cerr << "usage: rig MESH CHARACTER.vrm\n";
        return static_cast<int>(skelgen::ErrorCode::usage);
    }
    const auto mesh = skelgen::read_mesh(argv[1]);
    const auto found = skelgen::extract(mesh);
    const auto rig = make_rig(mesh, found.body, found.skeleton, skelgen::builtin_template("human21"),
                              skelgen::applications::RestPose::t_pose);
    skelgen::write_rig(argv[2], rig);

    std::cout << rig.joints.size() << " joints move " << rig.skin.weights.rows() << " vertices\n";
    return EXIT_SUCCESS;
} catch (const skelgen::Error& error) { // a file that cannot be read, a mesh without a body
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
}
