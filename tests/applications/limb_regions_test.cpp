#include <skelgen/applications/impl/limb_regions.hpp>
#include <skelgen/applications/segmentation.hpp>

#include <algorithm>
#include <string>

#include <skelgen/core/geometry.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "sample_body.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;

TEST_CASE("regions: what is of a limb may belong to that one alone", "[applications][weights]") {
    const auto& [mesh, found, skeleton, body] = test::sample_body();
    const LimbRegions regions = limb_regions(body, surface::to_body(body, skeleton), human());
    for (const char* name : {"crotch", "waist", "chest"})
        CHECK(regions.of_joint[static_cast<std::size_t>(find_joint(skeleton, name))] < 0);
    const auto region_of = [&](const char* name) {
        return regions.of_joint[static_cast<std::size_t>(find_joint(skeleton, name))];
    };
    CHECK(region_of("left_shoulder") == find_joint(skeleton, "left_hand"));
    CHECK(region_of("right_knee") == find_joint(skeleton, "right_foot"));
    CHECK(region_of("neck") == find_joint(skeleton, "head"));

    const Segmentation parts = segment(body, skeleton);
    for (std::size_t v = 0; v < parts.vertex_part.size(); ++v) {
        const std::string& part = parts.parts[static_cast<std::size_t>(parts.vertex_part[v])];
        for (const auto& [name, joint] : {std::pair{"left_forearm", "left_hand"},
                                          {"left_hand", "left_hand"},
                                          {"right_upper_arm", "right_hand"},
                                          {"right_calf", "right_foot"},
                                          {"left_foot", "left_foot"},
                                          {"head", "head"}})
            if (part == name) CHECK(regions.of_vertex[v] == find_joint(skeleton, joint));
    }
}

TEST_CASE("regions: a head that is wider than high is all the head's", "[applications][weights]") {
    TriangleMesh<double> mesh = test::sample_mesh();
    const auto& skeleton = test::sample_body().skeleton;
    const Vector3<double> head = skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, "head"))].position;
    constexpr double wider = 3;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        if (mesh.vertices(v, 2) < head.z()) continue;
        for (const int axis : {0, 1})
            mesh.vertices(v, axis) = head[axis] + wider * (mesh.vertices(v, axis) - head[axis]);
    }
    const Body<double> body = surface::make_body(mesh, Similarity<double>{}, {}, 0);
    const LimbRegions regions = limb_regions(body, surface::to_body(body, skeleton), human());
    for (Eigen::Index v = 0; v < body.mesh.vertices.rows(); ++v)
        if (body.mesh.vertices(v, 2) > head.z())
            CHECK(regions.of_vertex[static_cast<std::size_t>(v)] == find_joint(skeleton, "head"));
}

TEST_CASE("regions: a limb's end is on its own surface, whatever vertex lies against it", "[applications][weights]") {
    const test::SampleBody& sample = test::sample_body();
    TriangleMesh<double> mesh = sample.body.mesh;
    KinematicSkeleton<double> skeleton = surface::to_body(sample.body, sample.skeleton);
    const auto tip = std::find_if(skeleton.end_points.begin(), skeleton.end_points.end(),
                                  [](const auto& end) { return end.first == "left_fingertip"; });
    REQUIRE(tip != skeleton.end_points.end());
    const int finger = core::nearest_vertex(mesh, tip->second);
    Eigen::Index face = 0;
    while (!(mesh.faces.row(face).array() == finger).any()) ++face;
    tip->second.setZero();
    for (const int v : mesh.faces.row(face)) tip->second += core::point(mesh.vertices, v) / 3;
    const int belly =
        core::nearest_vertex(mesh, skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, "waist"))].position);
    mesh.vertices.row(belly) = tip->second.transpose().array() + 1e-5;
    const Body<double> touched = surface::make_body(mesh, Similarity<double>{}, {}, 0);
    REQUIRE(core::nearest_vertex(touched.mesh, tip->second) == belly);
    const LimbRegions regions = limb_regions(touched, skeleton, human());
    CHECK(regions.of_vertex[static_cast<std::size_t>(finger)] == find_joint(skeleton, "left_hand"));
    CHECK(regions.from_end[static_cast<std::size_t>(finger)] < 0.05);
}

TEST_CASE("regions: a limb without length has none, and binds nobody", "[applications][weights]") {
    const auto& [mesh, found, skeleton, body] = test::sample_body();
    KinematicSkeleton<double> one_armed = surface::to_body(body, skeleton);
    const auto at = [&](const char* name) { return static_cast<std::size_t>(find_joint(one_armed, name)); };
    for (const char* name : {"left_elbow", "left_wrist", "left_hand"})
        one_armed.joints[at(name)].position = one_armed.joints[at("left_shoulder")].position;
    std::erase_if(one_armed.end_points, [](const auto& end) { return end.first == "left_fingertip"; });
    const LimbRegions regions = limb_regions(body, one_armed, human());
    CHECK(regions.of_joint[at("left_shoulder")] < 0);
    for (const int region : regions.of_vertex) CHECK(region != find_joint(one_armed, "left_hand"));
}

} // namespace
