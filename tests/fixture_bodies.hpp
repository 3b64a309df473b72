#pragma once

// The synthetic bodies that several tests look at. Making one takes seconds: a program (fixtures/make_bodies.cpp) makes
// them all once, before the tests run, and here they are read.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/truth_json.hpp>

namespace skelgen::test {

/// A body and its true joints, those of human21 in its order.
struct FixtureBody {
    TriangleMesh<double> mesh;
    io::GroundTruth truth;
};

/// Where the bodies are: the environment variable SKELGEN_TEST_BODIES, or else what the build says.
inline std::filesystem::path fixture_folder() {
    const char* folder = std::getenv("SKELGEN_TEST_BODIES");
    if (folder != nullptr && *folder != '\0') return folder;
#ifdef SKELGEN_TEST_BODIES
    return SKELGEN_TEST_BODIES;
#else
    throw std::runtime_error("SKELGEN_TEST_BODIES names no folder: make one with skelgen-make-test-bodies");
#endif
}

/// One of walking-woman, standing-man, kneeling-boy, figure (8000 faces each; the last one with a head of a third of
/// its height), robot (a man of parts that do not touch), hands-clasped-woman, heels-together-man,
/// kneeling-on-heels-joined (13776, their limbs grown together where they touch), shepherd-raised, shepherd-a,
/// woodman-raised, fencer-a and fencer-walk (13776, with a staff, an axe or a sword in the right hand).
inline FixtureBody load_fixture_body(const std::string& name) {
    const std::filesystem::path folder = fixture_folder() / "bodies";
    return {io::read_mesh<double>(folder / (name + ".off")), io::read_ground_truth(folder / (name + ".json"))};
}

/// Meshes of things that are no human body, in the order of their names: synth::object_names(), 12000 faces each.
inline std::vector<std::filesystem::path> fixture_objects() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(fixture_folder() / "objects"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace skelgen::test
