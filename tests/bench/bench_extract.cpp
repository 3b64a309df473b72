// extract_skeleton beside CGAL's curve skeleton on the same real bodies, one thread each, their repetitions interleaved
// so that both meet the same machine. Ours finds named joints where CGAL's ends with the curve.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <skelgen/core/error.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "cgal_skeleton.hpp"

namespace {

using namespace skelgen;
namespace fs = std::filesystem;

constexpr std::size_t meshes_per_set = 4;
constexpr int repetitions = 7;
constexpr const char* our_side = "skelgen";
constexpr const char* their_side = "cgal";

struct Subject {
    std::string name; ///< <set>/<mesh>
    TriangleMesh<double> mesh;
    std::unique_ptr<bench::CgalSkeletonizer> cgal;
};

/// At most `count` of the files, evenly spaced in alphabetical order.
std::vector<fs::path> pick_files(const fs::path& folder, std::size_t count) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.size() <= count) return files;
    std::vector<fs::path> picked;
    for (std::size_t i = 0; i < count; ++i) picked.push_back(files[i * (files.size() - 1) / (count - 1)]);
    return picked;
}

std::vector<Subject> load_subjects(const fs::path& bodies) {
    std::vector<fs::path> sets;
    for (const fs::directory_entry& entry : fs::directory_iterator(bodies / "meshes"))
        if (entry.is_directory()) sets.push_back(entry.path());
    std::sort(sets.begin(), sets.end());
    std::vector<Subject> subjects;
    for (const fs::path& set : sets)
        for (const fs::path& file : pick_files(set, meshes_per_set)) {
            Subject subject{set.filename().string() + "/" + file.stem().string(), read_mesh<double>(file), nullptr};
            subject.cgal = std::make_unique<bench::CgalSkeletonizer>(subject.mesh);
            subjects.push_back(std::move(subject));
        }
    return subjects;
}

void run_ours(benchmark::State& state, const Subject& subject) {
    StageTimings timings;
    for ([[maybe_unused]] auto step : state) {
        try {
            timings = extract_skeleton(subject.mesh).timings;
        } catch (const Error& error) {
            state.SkipWithError(error.what());
            return;
        }
    }
    state.counters["curve_ms"] = timings.curve;
    state.counters["embed_ms"] = timings.embed;
    state.counters["refine_ms"] = timings.refine;
    state.counters["sides_ms"] = timings.sides;
}

void run_theirs(benchmark::State& state, const Subject& subject) {
    if (!subject.cgal->is_closed()) {
        state.SkipWithError("CGAL takes closed meshes only");
        return;
    }
    for ([[maybe_unused]] auto step : state) benchmark::DoNotOptimize(subject.cgal->run());
}

void register_subject(const Subject& subject) {
    const auto add = [&](const char* side, void (*run)(benchmark::State&, const Subject&)) {
        benchmark::RegisterBenchmark((std::string(side) + "/" + subject.name).c_str(),
                                     [run, &subject](benchmark::State& state) { run(state, subject); })
            ->Iterations(1)
            ->Repetitions(repetitions)
            ->ReportAggregatesOnly(true)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    };
    add(our_side, run_ours);
    add(their_side, run_theirs);
}

/// Prints and keeps the medians alone, and the errors.
class MedianKeeper : public benchmark::ConsoleReporter {
public:
    MedianKeeper() : ConsoleReporter(OO_None) {}

    void ReportRuns(const std::vector<Run>& runs) override {
        std::vector<Run> shown;
        for (const Run& run : runs) {
            if (run.aggregate_name == "median") medians_[run.run_name.function_name] = run.GetAdjustedRealTime();
            if (run.aggregate_name == "median" || run.run_type == Run::RT_Iteration) shown.push_back(run);
        }
        ConsoleReporter::ReportRuns(shown);
    }

    /// Milliseconds, 0 where the benchmark did not run.
    [[nodiscard]] double median(const std::string& name) const {
        const auto found = medians_.find(name);
        return found == medians_.end() ? 0 : found->second;
    }

private:
    std::map<std::string, double> medians_;
};

void print_ratios(const MedianKeeper& medians, const std::vector<Subject>& subjects) {
    std::printf("\n%-24s %8s %12s %12s %9s\n", "mesh", "faces", "skelgen ms", "CGAL ms", "ratio");
    double worst = 0;
    std::string worst_name = "none";
    for (const Subject& subject : subjects) {
        const double ours = medians.median(std::string(our_side) + "/" + subject.name);
        const double theirs = medians.median(std::string(their_side) + "/" + subject.name);
        if (ours <= 0 || theirs <= 0) continue;
        const double ratio = ours / theirs;
        std::printf("%-24s %8td %12.1f %12.1f %9.3f\n", subject.name.c_str(), subject.mesh.faces.rows(), ours, theirs,
                    ratio);
        if (ratio > worst) {
            worst = ratio;
            worst_name = subject.name;
        }
    }
    std::printf("worst ratio: %.3f (%s)\n", worst, worst_name.c_str());
}

int run_benchmarks(int argc, char** argv) {
    const char* bodies = std::getenv("SKELGEN_BODIES");
    if (bodies == nullptr || *bodies == '\0') {
        std::cerr << "skelgen-bench: set SKELGEN_BODIES to a folder that holds meshes/<set>/<mesh>\n";
        return EXIT_FAILURE;
    }
    std::vector<std::string> texts(argv, argv + argc);
    texts.insert(texts.begin() + 1, "--benchmark_enable_random_interleaving=true");
    std::vector<char*> arguments;
    for (std::string& text : texts) arguments.push_back(text.data());
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return EXIT_FAILURE;

    const std::vector<Subject> subjects = load_subjects(bodies);
    for (const Subject& subject : subjects) register_subject(subject);
    MedianKeeper reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    print_ratios(reporter, subjects);
    return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run_benchmarks(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "skelgen-bench: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
