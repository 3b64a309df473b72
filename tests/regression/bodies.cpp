#include "bodies.hpp"

#include <string>

#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/write_mesh.hpp>
#include <skelgen/synth/objects.hpp>
#include <skelgen/synth/quadrupeds.hpp>
#include <skelgen/synth/sets.hpp>

#include "parallel.hpp"
#include "tubes.hpp"

namespace skelgen::regression {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t seed = 1;
constexpr int object_faces = 8000;
constexpr const char* done = "done"; ///< a file that tells a finished folder from one that was interrupted

struct Made {
    std::string name;
    TriangleMesh<double> mesh;
    std::string truth;
};

/// Makes `count` things and writes them and what is known of them.
template <typename Make>
void make_set(const fs::path& folder, const std::string& set, std::size_t count, unsigned jobs, const Make& make) {
    fs::create_directories(folder / "meshes" / set);
    fs::create_directories(folder / "truth" / set);
    test::for_each_index(count, jobs, [&](std::size_t i) {
        const Made made = make(i);
        write_mesh(folder / "meshes" / set / (made.name + ".off"), made.mesh);
        io::write_file_atomically(folder / "truth" / set / (made.name + ".json"), made.truth);
    });
}

} // namespace

const std::vector<SetSample>& body_samples() {
    static const std::vector<SetSample> samples{
        {"scape", 14}, {"faust", 9},   {"proportions", 3}, {"partial", 3}, {"joined", 2}, {"scan", 2}, {"dressed", 2},
        {"pieces", 3}, {"cartoon", 6}, {"curled", 5},      {"mouths", 2},  {"armed", 2},  {"hands", 1}};
    return samples;
}

void make_bodies(const fs::path& folder, unsigned jobs) {
    fs::remove_all(folder);
    for (const SetSample& sample : body_samples()) {
        const std::vector<synth::BodyPlan> plans = synth::body_set(sample.set, seed);
        make_set(folder, sample.set, (plans.size() + sample.stride - 1) / sample.stride, jobs, [&](std::size_t i) {
            const synth::BodyPlan& plan = plans[i * sample.stride];
            const synth::SynthBody body = synth::synthesize_body(plan);
            return Made{plan.name, body.mesh, synth::truth_to_json(body.truth, sample.set + "/" + plan.name + ".off")};
        });
    }
    const std::vector<synth::QuadrupedPlan> animals = synth::quadruped_plans(seed);
    make_set(folder, quadruped_set, animals.size(), jobs, [&](std::size_t i) {
        const TriangleMesh<double> mesh = synth::synthesize_quadruped(animals[i], object_faces);
        const std::string file = animals[i].body.name + ".off";
        return Made{animals[i].body.name, mesh,
                    synth::quadruped_truth_to_json(animals[i], mesh, std::string(quadruped_set) + "/" + file)};
    });
    const std::vector<std::string> objects = synth::object_names();
    make_set(folder, "not-a-body", objects.size(), jobs, [&](std::size_t i) {
        return Made{objects[i], synth::synthesize_object(objects[i], object_faces),
                    synth::object_truth_to_json("not-a-body/" + objects[i] + ".off")};
    });
    make_tubes(folder / "tubes", jobs);
    io::write_file_atomically(folder / done, "");
}

bool has_bodies(const fs::path& folder) { return fs::exists(folder / done) && fs::exists(folder / "tubes"); }

} // namespace skelgen::regression
