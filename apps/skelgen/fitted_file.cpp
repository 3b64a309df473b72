#include "fitted_file.hpp"

#include <string>

#include "console.hpp"

namespace skelgen::cli {

FittedFile fit_file(const MeshInput& input, ExtractOptions options) {
    FittedFile out;
    out.mesh = load_mesh(input);
    options.with_curve = false;
    out.found = extract_body(out.mesh, options);
    out.source = {input.file.filename().string(), out.mesh.vertices.rows(), out.mesh.faces.rows(),
                  out.found.extraction.geodesic_diameter};
    return out;
}

void print_warnings(const std::filesystem::path& file, const KinematicSkeleton<double>& skeleton) {
    constexpr double likely = 0.6; // below, sides or limbs are wrong often: README, Measured
    for (const std::string& warning : skeleton.quality.warnings) print_warning(file.string() + ": " + warning);
    if (skeleton.quality.sides_confidence < likely)
        print_warning(file.string() + ": the skeleton is a guess: confidence " +
                      std::to_string(skeleton.quality.sides_confidence).substr(0, 4) + "; look at it (render)");
}

} // namespace skelgen::cli
