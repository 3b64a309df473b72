#include <skelgen/applications/segmentation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/impl/surface_labels.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

#include "applications/sample_body.hpp"
#include "catch.hpp"
#include "mesh_changes.hpp"

using namespace skelgen;
using namespace skelgen::applications;
using namespace skelgen::test;

namespace {

struct Parted {
    TriangleMesh<double> mesh;
    KinematicSkeleton<double> skeleton;
    Segmentation parts;

    [[nodiscard]] const std::string& part_of(int vertex) const {
        return parts.parts.at(static_cast<std::size_t>(parts.vertex_part.at(static_cast<std::size_t>(vertex))));
    }
    /// Of the vertex nearest to a place.
    [[nodiscard]] const std::string& part_near(const Vector3<double>& place) const {
        return part_of(core::nearest_vertex(mesh, place));
    }
};

Parted parted(const TriangleMesh<double>& mesh, PartSet set) {
    const Extraction<double> found = extract(mesh);
    return {mesh, found.skeleton, to_input(segment(found.body, found.skeleton, set), found.body, mesh)};
}

/// How many pieces the vertices of one part are in, joined by edges.
int pieces_of(const Parted& body, int part) {
    core::DisjointSets pieces(body.parts.vertex_part.size());
    const auto is_in = [&](int v) { return body.parts.vertex_part[static_cast<std::size_t>(v)] == part; };
    for (Eigen::Index f = 0; f < body.mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (const int a = body.mesh.faces(f, k), b = body.mesh.faces(f, (k + 1) % 3); is_in(a) && is_in(b))
                pieces.unite(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    const auto others = std::count_if(body.parts.vertex_part.begin(), body.parts.vertex_part.end(),
                                      [&](int other) { return other != part; });
    return static_cast<int>(pieces.count()) - static_cast<int>(others);
}

} // namespace

TEST_CASE("segmentation: names of the parts, sides in front", "[applications]") {
    CHECK(part_names(PartSet::bones).size() == 19);
    const std::vector<std::string> body = part_names(PartSet::body);
    CHECK(body == std::vector<std::string>{"head", "torso", "left_upper_arm", "left_forearm", "left_hand", "left_thigh",
                                           "left_calf", "left_foot", "right_upper_arm", "right_forearm", "right_hand",
                                           "right_thigh", "right_calf", "right_foot"});
}

TEST_CASE("segmentation: each part of a body is where its bone is, in one piece", "[applications]") {
    const PartSet set = GENERATE(PartSet::bones, PartSet::body);
    const Parted body = parted(sample_mesh(), set);
    REQUIRE(body.parts.parts == part_names(set));
    REQUIRE(body.parts.vertex_part.size() == static_cast<std::size_t>(body.mesh.vertices.rows()));
    REQUIRE(body.parts.face_part.size() == static_cast<std::size_t>(body.mesh.faces.rows()));
    const auto at = [&](const std::string& joint) { return joint_place(body.skeleton, joint); };
    CHECK(body.part_near(end_place(body.skeleton, "head_top", "head")) == "head");
    for (const std::string side : {"left_", "right_"}) {
        CHECK(body.part_near(end_place(body.skeleton, side + "fingertip", "head")) == side + "hand");
        CHECK(body.part_near(end_place(body.skeleton, side + "toe", "head")) == side + "foot");
        CHECK(body.part_near((at(side + "shoulder") + at(side + "elbow")) / 2) == side + "upper_arm");
        CHECK(body.part_near((at(side + "elbow") + at(side + "wrist")) / 2) == side + "forearm");
        CHECK(body.part_near((at(side + "hip") + at(side + "knee")) / 2) == side + "thigh");
        CHECK(body.part_near((at(side + "knee") + at(side + "ankle")) / 2) == side + "calf");
    }
    CHECK(body.part_near(at("waist")) == (set == PartSet::bones ? "abdomen" : "torso"));
    for (std::size_t part = 0; part < body.parts.parts.size(); ++part) {
        INFO(body.parts.parts[part]);
        CHECK(pieces_of(body, static_cast<int>(part)) == 1);
    }
    for (Eigen::Index f = 0; f < body.mesh.faces.rows(); ++f) {
        const auto corner = [&](int k) {
            return body.parts.vertex_part[static_cast<std::size_t>(body.mesh.faces(f, k))];
        };
        const int part = body.parts.face_part[static_cast<std::size_t>(f)];
        REQUIRE((part == corner(0) || part == corner(1) || part == corner(2)));
    }
}

TEST_CASE("segmentation: a body turned and shuffled has the same parts", "[applications]") {
    const TriangleMesh<double> mesh = sample_mesh();
    const Parted expected = parted(mesh, PartSet::bones);
    const Parted turned =
        parted(shuffled(moved(mesh, {random_rotation(3), 1000, Vector3<double>(5, 6, 7)}), 1), PartSet::bones);
    const auto count_of = [](const Parted& body, std::size_t part) {
        return std::count(body.parts.vertex_part.begin(), body.parts.vertex_part.end(), static_cast<int>(part));
    };
    for (std::size_t part = 0; part < expected.parts.parts.size(); ++part) {
        INFO(expected.parts.parts[part]);
        CHECK(std::abs(count_of(turned, part) - count_of(expected, part)) <= 2); // a tie may fall to either side
    }
}

TEST_CASE("segmentation: what the body left out belongs to the part that it is nearest to", "[applications]") {
    TriangleMesh<double> mesh = sample_mesh();
    const Parted without = parted(mesh, PartSet::bones);
    const Vector3<double> toe = end_place(without.skeleton, "left_toe", "left_foot");
    mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3); // a vertex that no face uses
    core::set_point<double>(mesh.vertices, mesh.vertices.rows() - 1, toe + Vector3<double>(0.01, 0.01, 0.01));
    const Parted body = parted(mesh, PartSet::bones);
    CHECK(body.part_of(static_cast<int>(mesh.vertices.rows()) - 1) == "left_foot");
}

TEST_CASE("segmentation: bad options, skeletons and meshes", "[applications]") {
    const Extraction<double> found = extract(sample_mesh());
    const KinematicSkeleton<double>& skeleton = found.skeleton;
    for (const double bad : {0.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
        SegmentationOptions options;
        options.smoothing = bad;
        CHECK_THROWS_WITH(segment(found.body, skeleton, PartSet::body, options),
                          Catch::Matchers::Contains("segmentation.smoothing"));
    }
    SegmentationOptions wide;
    wide.shoulder = 3;
    CHECK_THROWS_WITH(segment(found.body, skeleton, PartSet::bones, wide),
                      Catch::Matchers::Contains("segmentation.shoulder"));
    KinematicSkeleton<double> other = skeleton;
    other.joints.pop_back();
    CHECK_THROWS_AS(segment(found.body, other), Error);
    TriangleMesh<double> smaller = sample_mesh();
    smaller.vertices.conservativeResize(100, 3);
    CHECK_THROWS_AS(to_input(segment(found.body, skeleton), found.body, smaller), Error);
}

TEST_CASE("segmentation: a strip that divides a part becomes that part", "[applications]") {
    const SampleBody& sample = sample_body();
    const auto height = [&](Eigen::Index v) {
        return sample.body.similarity.to_input(core::point(sample.body.mesh.vertices, v)).z();
    };
    // Rings around the calves, of the label that the upper body has: the feet below them stay the legs'.
    std::vector<int> labels;
    for (Eigen::Index v = 0; v < sample.body.mesh.vertices.rows(); ++v)
        labels.push_back(height(v) > 1 || (height(v) > 0.3 && height(v) < 0.36) ? 1 : 0);
    const std::vector<int> whole = in_one_piece(sample.body, labels, 2);
    int below = 0;
    for (Eigen::Index v = 0; v < sample.body.mesh.vertices.rows(); ++v) {
        if (height(v) < 0.36) {
            ++below;
            CHECK(whole[static_cast<std::size_t>(v)] == 0);
        }
        if (height(v) > 1) CHECK(whole[static_cast<std::size_t>(v)] == 1);
    }
    CHECK(below > 100);
}
