// A user's program: it links only when the package brings all that the whole pipeline needs.

#include <cstdlib>
#include <iostream>

#include <skelgen/skelgen.hpp>

namespace {

skelgen::TriangleMesh<double> tetrahedron() {
    skelgen::TriangleMesh<double> mesh;
    mesh.vertices.resize(4, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    mesh.faces.resize(4, 3);
    mesh.faces << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
    return mesh;
}

bool finds_no_body(const skelgen::TriangleMesh<double>& mesh) {
    try {
        (void)skelgen::extract_skeleton(mesh);
    } catch (const skelgen::Error& error) {
        return error.code() == skelgen::ErrorCode::no_skeleton || error.code() == skelgen::ErrorCode::bad_input;
    }
    return false;
}

} // namespace

int main() {
    const auto joints = skelgen::builtin_template("human21").joints.size();
    std::cout << "skelgen " << skelgen::version << ": human21 has " << joints << " joints\n";
    return joints == 21 && finds_no_body(tetrahedron()) ? EXIT_SUCCESS : EXIT_FAILURE;
}
