// What must not change a skeleton, on scans of people. They are not part of the project: SKELGEN_BODIES says where they
// are.

#include <filesystem>
#include <string>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "catch.hpp"
#include "extract/same_skeleton.hpp"
#include "mesh_changes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

struct RealBody {
    std::string name;
    TriangleMesh<double> mesh;
};

std::vector<RealBody> read_bodies(const std::filesystem::path& folder) {
    std::vector<RealBody> out;
    for (const char* name : {"faust/tr_reg_000.off", "faust/tr_reg_013.off", "faust/tr_reg_037.off",
                             "scape/mesh000.off", "scape/mesh020.off", "psb/1.off"})
        if (const auto file = folder / "meshes" / name; std::filesystem::exists(file))
            out.push_back({name, read_mesh(file)});
    REQUIRE_FALSE(out.empty()); // a folder that SKELGEN_BODIES names holds bodies
    return out;
}

} // namespace

TEST_CASE("real bodies: place, size and direction do not matter") {
    if (!bodies_folder()) SKELGEN_SKIP("SKELGEN_BODIES does not name a folder of bodies");
    for (const auto& [name, mesh] : read_bodies(*bodies_folder())) {
        const Extraction<double> expected = extract_skeleton(mesh);
        const Vector3<double> far = 100 * expected.geodesic_diameter * Vector3<double>(0.6, -0.64, 0.48);
        int number = 0;
        for (const Motion& motion :
             {Motion{random_rotation(1), 0.001, 0.001 * far}, Motion{random_rotation(2), 1000, 1000 * far},
              Motion{random_rotation(3), 1, Vector3<double>::Zero()}}) {
            INFO(name << ", motion " << ++number);
            const Difference d = difference(extract_skeleton(moved(mesh, motion)), expected, motion);
            INFO("at " << d.where);
            CHECK(d.joint < by_motion);
            CHECK(d.end < by_motion);
            CHECK(d.frame_angle < 1e-6);
        }
    }
}

TEST_CASE("real bodies: the order of vertices and faces does not matter") {
    if (!bodies_folder()) SKELGEN_SKIP("SKELGEN_BODIES does not name a folder of bodies");
    for (const auto& [name, mesh] : read_bodies(*bodies_folder())) {
        INFO(name);
        const Difference d = difference(extract_skeleton(shuffled(mesh, 1)), extract_skeleton(mesh));
        INFO("at " << d.where);
        CHECK(d.joint < by_motion);
        CHECK(d.end < by_motion);
        CHECK(d.frame_angle < 1e-6);
    }
}

TEST_CASE("real bodies: single precision is precise enough") {
    if (!bodies_folder()) SKELGEN_SKIP("SKELGEN_BODIES does not name a folder of bodies");
    for (const auto& [name, mesh] : read_bodies(*bodies_folder())) {
        INFO(name);
        const TriangleMesh<float> rounded{mesh.vertices.cast<float>(), mesh.faces};
        const Difference d = difference(extract_skeleton(rounded), extract_skeleton(mesh));
        INFO("at " << d.where);
        CHECK(d.joint < by_rounding);
        CHECK(d.frame_angle < 0.1);
    }
}

TEST_CASE("real bodies: the same skeleton twice, its joints and the curve inside") {
    if (!bodies_folder()) SKELGEN_SKIP("SKELGEN_BODIES does not name a folder of bodies");
    for (const auto& [name, mesh] : read_bodies(*bodies_folder())) {
        INFO(name);
        const Extraction<double> a = extract_skeleton(mesh), b = extract_skeleton(mesh);
        CHECK(a.curve.nodes == b.curve.nodes);
        for (std::size_t j = 0; j < a.skeleton.joints.size(); ++j) {
            INFO(a.skeleton.joints[j].name);
            CHECK(a.skeleton.joints[j].position == b.skeleton.joints[j].position);
            CHECK(winding_number(mesh, a.skeleton.joints[j].position) > 0.5);
        }
        const CurveGraph<double> graph = curve_graph(a.curve);
        for (int node = 0; node < graph.size(); ++node) {
            INFO("node " << node);
            CHECK(a.curve.radii[static_cast<std::size_t>(node)] > 0);
            if (graph.degree(node) > 1)
                CHECK(winding_number(mesh, Vector3<double>(a.curve.nodes.row(node).transpose())) > 0.5);
        }
    }
}
