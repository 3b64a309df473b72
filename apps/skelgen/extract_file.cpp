#include "extract_file.hpp"

#include <chrono>

namespace skelgen::cli {

FileExtraction extract_file(const MeshInput& input, const ExtractOptions& options) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto ms_since_start = [&] { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); };

    const TriangleMesh<double> mesh = load_mesh(input);
    const double read_ms = ms_since_start();

    FileExtraction result;
    result.extraction = extract_skeleton(mesh, options);
    io::FileTimings timings{read_ms, result.extraction.timings};
    timings.stages.total = ms_since_start();
    result.provenance.mesh = io::SourceMesh{input.file.filename().string(), mesh.vertices.rows(), mesh.faces.rows(),
                                            result.extraction.geodesic_diameter};
    result.provenance.timings_ms = timings;
    result.json = skeleton_to_json(result.extraction.skeleton, result.provenance);
    return result;
}

} // namespace skelgen::cli
