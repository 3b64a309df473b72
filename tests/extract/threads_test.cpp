#include <skelgen/extract.hpp>

#include <string>
#include <thread>

#include <skelgen/core/parallel.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

/// All numbers of an extraction but its times.
void check_same(const Extraction<double>& a, const Extraction<double>& b) {
    REQUIRE(a.skeleton.joints.size() == b.skeleton.joints.size());
    for (std::size_t j = 0; j < a.skeleton.joints.size(); ++j) {
        CHECK(a.skeleton.joints[j].position == b.skeleton.joints[j].position);
        CHECK(a.skeleton.joints[j].radius == b.skeleton.joints[j].radius);
        CHECK(a.skeleton.joints[j].confidence == b.skeleton.joints[j].confidence);
    }
    CHECK(a.curve.nodes == b.curve.nodes);
    CHECK(a.curve.edges == b.curve.edges);
    CHECK(a.curve.radii == b.curve.radii);
    CHECK(a.curve.regions == b.curve.regions);
    CHECK(a.skeleton.end_points == b.skeleton.end_points);
    CHECK(a.geodesic_diameter == b.geodesic_diameter);
}

} // namespace

TEST_CASE("a skeleton is the same by however many threads", "[extract][slow]") {
    const int times = GENERATE(0, 2); // 14 thousand faces as they are; 220 thousand, of which clusters are made
    const Mesh body = subdivided(read_mesh<double>(SKELGEN_DATA "/sample/body.off"), times);
    ExtractOptions options;
    const Extraction<double> alone = extract_skeleton(body, options);
    for (const int threads : {2, 3}) {
        options.threads = threads;
        check_same(alone, extract_skeleton(body, options));
    }
}

TEST_CASE("bodies looked at at once have the skeletons that they have alone", "[extract][slow]") {
    const Mesh body = read_mesh<double>(SKELGEN_DATA "/sample/body.off");
    const Mesh other = moved(body, {random_rotation(3), 2, Vec3(1, 2, 3)});
    const Extraction<double> alone = extract_skeleton(body), other_alone = extract_skeleton(other);
    ExtractOptions options;
    options.threads = 2;
    Extraction<double> found, other_found;
    std::thread beside([&] { other_found = extract_skeleton(other, options); });
    found = extract_skeleton(body, options);
    beside.join();
    check_same(alone, found);
    check_same(other_alone, other_found);
}

TEST_CASE("a number of threads that is none is refused", "[extract]") {
    ExtractOptions options;
    options.threads = GENERATE(0, -1, 1025);
    CHECK_THROWS_AS(validate(options), Error);
}

TEST_CASE("what stands for a large mesh has the joints of the whole", "[extract][slow]") {
    const Mesh body = subdivided(read_mesh<double>(SKELGEN_DATA "/sample/body.off"), 2);
    ExtractOptions whole;
    whole.prepare.most_faces = 0;
    const Extraction<double> expected = extract_skeleton(body, whole), found = extract_skeleton(body);
    REQUIRE(found.skeleton.joints.size() == expected.skeleton.joints.size());
    double sum = 0;
    for (std::size_t j = 0; j < expected.skeleton.joints.size(); ++j)
        sum += (found.skeleton.joints[j].position - expected.skeleton.joints[j].position).norm();
    // No more than two triangulations of one surface differ.
    CHECK(sum / static_cast<double>(expected.skeleton.joints.size()) < 0.003 * expected.geodesic_diameter);
    CHECK(found.geodesic_diameter == Approx(expected.geodesic_diameter).epsilon(0.02));
}
