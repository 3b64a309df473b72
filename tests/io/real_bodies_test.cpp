#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <skelgen/io/write_mesh.hpp>

#include "mesh_expectations.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> mesh_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && mesh_format_of(entry.path()) == MeshFormat::off) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

TEST_CASE("read_mesh: real bodies lose no vertex and no face", "[io][bodies]") {
    const auto bodies = bodies_folder();
    if (!bodies) SKELGEN_SKIP("SKELGEN_BODIES names no folder of real bodies");
    const std::vector<fs::path> files = mesh_files(*bodies / "meshes");
    REQUIRE_FALSE(files.empty());
    for (const fs::path& file : files) {
        INFO(file);
        std::string keyword;
        Eigen::Index vertices = 0, faces = 0;
        std::ifstream(file) >> keyword >> vertices >> faces;
        const TriangleMesh<double> mesh = read_mesh(file);
        CHECK(mesh.vertices.rows() == vertices);
        CHECK(mesh.faces.rows() == faces);
    }
    const TriangleMesh<double> mesh = read_mesh(files.front());
    check_same(parse_mesh(format_mesh(mesh, MeshFormat::ply)), mesh);
}
