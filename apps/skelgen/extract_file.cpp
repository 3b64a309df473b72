#include "extract_file.hpp"

#include <chrono>
#include <utility>

#include <skelgen/core/parallel.hpp>
#include <skelgen/hands/find_hands.hpp>

namespace skelgen::cli {

const std::map<std::string, Fingers>& fingers_by_name() {
    static const std::map<std::string, Fingers> names{
        {"auto", Fingers::automatic}, {"off", Fingers::off}, {"on", Fingers::on}};
    return names;
}

FileExtraction extract_file(const MeshInput& input, const ExtractOptions& options, Fingers fingers) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto ms_since_start = [&] { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); };

    FileExtraction result;
    const core::ThreadScope threads(options.threads);
    TriangleMesh<double> mesh = load_mesh(input);
    const double read_ms = ms_since_start();

    result.found = extract(std::move(mesh), options);
    KinematicSkeleton<double> skeleton = result.skeleton();
    if (fingers != Fingers::off) {
        const auto hands = hands::find_hands(result.mesh(), result.found.body, skeleton);
        if (fingers == Fingers::on || hands::has_digits(hands)) {
            skeleton = hands::with_digits(std::move(skeleton), hands);
            result.provenance.fused = hands::fused_digits(hands);
        }
    }
    io::FileTimings timings{read_ms, result.found.timings};
    timings.stages.total = ms_since_start();
    result.source = source_of(input, result.found);
    result.provenance.mesh = result.source;
    result.provenance.timings_ms = timings;
    result.json = skeleton_to_json(skeleton, result.provenance);
    return result;
}

} // namespace skelgen::cli
