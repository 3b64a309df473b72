#include "tubes.hpp"

#include <exception>
#include <iomanip>
#include <iostream>
#include <sstream>

#include <skelgen/extract.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/axis_json.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/write_mesh.hpp>
#include <skelgen/synth/tubes.hpp>

#include "parallel.hpp"

namespace skelgen::regression {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t seed = 1;

/// What a tube's curve is to be found with.
ExtractOptions options_for(const synth::TubePlan& plan) {
    ExtractOptions options;
    if (plan.fine) options.curve.detail = curve::Detail::all;
    return options;
}

CurveSkeleton<double> find_curve_in(const fs::path& mesh, const synth::TubePlan& plan) {
    try {
        return find_curve_skeleton(io::read_mesh<double>(mesh), options_for(plan));
    } catch (const std::exception& error) {
        std::cerr << mesh.string() + ": " + error.what() + "\n";
        return {};
    }
}

} // namespace

void make_tubes(const fs::path& folder, unsigned jobs) {
    fs::create_directories(folder);
    const std::vector<synth::TubePlan> plans = synth::tube_plans(seed);
    test::for_each_index(plans.size(), jobs, [&](std::size_t i) {
        const synth::SynthTube tube = synth::synthesize_tube(plans[i], plans[i].faces);
        const std::string mesh = plans[i].name + ".off";
        write_mesh(folder / mesh, tube.mesh);
        io::write_file_atomically(folder / (plans[i].name + ".json"), synth::curve_truth_to_json(tube.truth, mesh));
    });
}

std::vector<TubeScore> measure_tubes(const fs::path& folder, unsigned jobs) {
    const std::vector<synth::TubePlan> plans = synth::tube_plans(seed);
    std::vector<TubeScore> scores(plans.size());
    test::for_each_index(plans.size(), jobs, [&](std::size_t i) {
        const CurveSkeleton<double> truth = io::read_axis_truth(folder / (plans[i].name + ".json"));
        const CurveSkeleton<double> curve = find_curve_in(folder / (plans[i].name + ".off"), plans[i]);
        scores[i] = {plans[i].name, evaluation::measure_curve(curve, truth)};
    });
    return scores;
}

std::string to_table(const std::vector<TubeScore>& scores) {
    std::ostringstream text;
    text << "tube               ends  cycles  hausdorff    mean  radius  end gap\n"
         << std::fixed << std::setprecision(3);
    for (const auto& [name, error] : scores) {
        const auto of = [](int found, int known) { return std::to_string(found) + "/" + std::to_string(known); };
        text << std::left << std::setw(16) << name << std::right << std::setw(7) << of(error.ends, error.true_ends)
             << std::setw(8) << of(error.cycles, error.true_cycles) << std::setw(11) << error.hausdorff << std::setw(8)
             << error.mean << std::setw(8) << error.radius_error << std::setw(9) << error.end_error << '\n';
    }
    return text.str();
}

} // namespace skelgen::regression
