#include "extract_file.hpp"

#include <chrono>
#include <utility>

#include <skelgen/core/parallel.hpp>
#include <skelgen/hands/find_hands.hpp>

#include "console.hpp"

namespace skelgen::cli {

const std::map<std::string, Fingers>& fingers_by_name() {
    static const std::map<std::string, Fingers> names{
        {"auto", Fingers::automatic}, {"off", Fingers::off}, {"on", Fingers::on}};
    return names;
}

FingeredSkeleton with_fingers(const TriangleMesh<double>& mesh, const Extraction<double>& found, Fingers fingers,
                              bool toes) {
    FingeredSkeleton out{found.skeleton};
    if (fingers != Fingers::off)
        if (const auto hands = hands::find_hands(mesh, found.body, found.skeleton);
            fingers == Fingers::on || hands::has_digits(hands))
            out = {hands::with_digits(found.skeleton, hands), hands::fused_digits(hands)};
    if (toes) {
        const auto feet = hands::find_feet(mesh, found.body, found.skeleton);
        out.skeleton = hands::with_toes(std::move(out.skeleton), feet);
        for (auto& fused : hands::fused_digits(feet)) out.fused.push_back(std::move(fused));
    }
    return out;
}

std::pair<std::string, Fingers> template_and_fingers(const std::string& skeleton_template, const std::string& fingers,
                                                     bool toes) {
    if (toes && skeleton_template != "human21" && skeleton_template != hands::template_with_digits)
        throw Error(ErrorCode::usage, "toes go with human21 and human51 alone");
    if (skeleton_template == hands::template_with_digits) return {"human21", Fingers::on};
    const auto known = fingers_by_name().find(fingers);
    if (known == fingers_by_name().end())
        throw Error(ErrorCode::usage, "fingers: '" + fingers + "' is none of auto, off, on");
    if (known->second != Fingers::off && skeleton_template != "human21")
        throw Error(ErrorCode::usage, "fingers " + fingers + ": fingers go with human21 alone");
    return {skeleton_template, known->second};
}

FileExtraction extract_file(const MeshInput& input, const ExtractOptions& options, Fingers fingers,
                            const std::vector<Hint>& hints, bool toes) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto ms_since_start = [&] { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); };

    FileExtraction result;
    const core::ThreadScope threads(options.threads);
    TriangleMesh<double> mesh = load_mesh(input);
    const double read_ms = ms_since_start();

    result.found = hints.empty() ? extract(std::move(mesh), options) : extract_hinted(std::move(mesh), hints, options);
    FingeredSkeleton shown = with_fingers(result.mesh(), result.found, fingers, toes);
    result.provenance.fused = std::move(shown.fused);
    io::FileTimings timings{read_ms, result.found.timings};
    timings.stages.total = ms_since_start();
    result.source = source_of(input, result.found);
    result.provenance.mesh = result.source;
    result.provenance.timings_ms = timings;
    result.json = skeleton_to_json(shown.skeleton, result.provenance);
    return result;
}

} // namespace skelgen::cli
