#include "extract_file.hpp"

#include <chrono>

#include <skelgen/core/parallel.hpp>

namespace skelgen::cli {

FileExtraction extract_file(const MeshInput& input, const ExtractOptions& options) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto ms_since_start = [&] { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); };

    FileExtraction result;
    const core::ThreadScope threads(options.threads);
    result.mesh = load_mesh(input);
    const double read_ms = ms_since_start();

    result.found = extract_body(result.mesh, options);
    const Extraction<double>& extraction = result.found.extraction;
    io::FileTimings timings{read_ms, extraction.timings};
    timings.stages.total = ms_since_start();
    result.source = {input.file.filename().string(), result.mesh.vertices.rows(), result.mesh.faces.rows(),
                     extraction.geodesic_diameter};
    result.provenance.mesh = result.source;
    result.provenance.timings_ms = timings;
    result.json = skeleton_to_json(extraction.skeleton, result.provenance);
    return result;
}

} // namespace skelgen::cli
