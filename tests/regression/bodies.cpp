#include "bodies.hpp"

#include <utility>

#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/write_mesh.hpp>
#include <skelgen/synth/objects.hpp>
#include <skelgen/synth/sets.hpp>

#include "parallel.hpp"
#include "tubes.hpp"

namespace skelgen::regression {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t seed = 1;
constexpr int object_faces = 8000;
constexpr const char* done = "done"; ///< a file that tells a finished folder from one that was interrupted

} // namespace

const std::vector<SetSample>& body_samples() {
    static const std::vector<SetSample> samples{{"scape", 14},  {"faust", 9},  {"proportions", 3}, {"partial", 3},
                                                {"joined", 2},  {"scan", 2},   {"dressed", 2},     {"pieces", 3},
                                                {"cartoon", 6}, {"curled", 5}, {"mouths", 2},      {"armed", 2}};
    return samples;
}

void make_bodies(const fs::path& folder, unsigned jobs) {
    fs::remove_all(folder);
    std::vector<std::pair<std::string, synth::BodyPlan>> bodies;
    for (const SetSample& sample : body_samples()) {
        fs::create_directories(folder / "meshes" / sample.set);
        fs::create_directories(folder / "truth" / sample.set);
        const std::vector<synth::BodyPlan> plans = synth::body_set(sample.set, seed);
        for (std::size_t i = 0; i < plans.size(); i += sample.stride) bodies.emplace_back(sample.set, plans[i]);
    }
    test::for_each_index(bodies.size(), jobs, [&](std::size_t i) {
        const auto& [set, plan] = bodies[i];
        const synth::SynthBody body = synth::synthesize_body(plan);
        write_mesh(folder / "meshes" / set / (plan.name + ".off"), body.mesh);
        io::write_file_atomically(folder / "truth" / set / (plan.name + ".json"),
                                  synth::truth_to_json(body.truth, set + "/" + plan.name + ".off"));
    });

    const std::string set = "not-a-body";
    fs::create_directories(folder / "meshes" / set);
    fs::create_directories(folder / "truth" / set);
    const std::vector<std::string> objects = synth::object_names();
    test::for_each_index(objects.size(), jobs, [&](std::size_t i) {
        write_mesh(folder / "meshes" / set / (objects[i] + ".off"), synth::synthesize_object(objects[i], object_faces));
        io::write_file_atomically(folder / "truth" / set / (objects[i] + ".json"),
                                  synth::object_truth_to_json(set + "/" + objects[i] + ".off"));
    });
    make_tubes(folder / "tubes", jobs);
    io::write_file_atomically(folder / done, "");
}

bool has_bodies(const fs::path& folder) { return fs::exists(folder / done) && fs::exists(folder / "tubes"); }

} // namespace skelgen::regression
