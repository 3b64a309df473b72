#include "fitted_file.hpp"

#include <string>
#include <utility>

#include "console.hpp"

namespace skelgen::cli {

io::SourceMesh source_of(const MeshInput& input, const Extraction<double>& found) {
    return {input.file.filename().string(), found.mesh.vertices.rows(), found.mesh.faces.rows(),
            found.geodesic_diameter};
}

FittedFile fit_file(const MeshInput& input, ExtractOptions options) {
    FittedFile out;
    options.with_curve = false;
    out.found = extract(load_mesh(input), options);
    out.source = source_of(input, out.found);
    return out;
}

FittedFile with_own_part(FittedFile file) {
    auto own = applications::own_body(std::move(file.found.mesh), std::move(file.found.body));
    file.found.mesh = std::move(own.mesh);
    file.found.body = std::move(own.body);
    file.part = std::move(own.part);
    return file;
}

void print_warnings(const std::filesystem::path& file, const KinematicSkeleton<double>& skeleton) {
    constexpr double likely = 0.5; // below, it is more often wrong than right
    for (const std::string& warning : skeleton.quality.warnings) print_warning(file.string() + ": " + warning);
    if (skeleton.quality.sides_confidence < likely)
        print_warning(file.string() + ": the skeleton is a guess: confidence " +
                      std::to_string(skeleton.quality.sides_confidence).substr(0, 4) + "; look at it (render)");
}

} // namespace skelgen::cli
