#include "fitted_file.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include <skelgen/fit_skeleton.hpp>
#include <skelgen/hands/find_hands.hpp>
#include <skelgen/io/template_json.hpp>
#include <skelgen/search/trust.hpp>

#include "console.hpp"
#include "rig_joints.hpp"

namespace skelgen::cli {

io::SourceMesh source_of(const MeshInput& input, const Extraction<double>& found) {
    return {input.file.filename().string(), found.mesh.vertices.rows(), found.mesh.faces.rows(),
            found.geodesic_diameter};
}

void want_template(ExtractOptions& options, const std::string& name_or_file) {
    options.or_quadruped = name_or_file == "auto";
    options.skeleton_template =
        in_file("--template", [&] { return io::load_template(options.or_quadruped ? "human21" : name_or_file); });
}

FittedFile fit_file(const MeshInput& input, ExtractOptions options, bool with_curve) {
    FittedFile out;
    options.with_curve = with_curve;
    want_template(options, input.wanted);
    if (input.use_rig) {
        out.found = extract_with_rig(input, options);
    } else if (input.skeleton.empty()) {
        out.found = extract(load_mesh(input), options);
    } else {
        auto skeleton = in_file(input.skeleton, [&] { return hands::without_digits(read_skeleton(input.skeleton)); });
        out.found = fit_skeleton(load_mesh(input), std::move(skeleton), options);
        out.found.skeleton.quality.sides_confidence = 1; // who gives a skeleton answers for it
    }
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

namespace {

/// What was repaired, without how: "seams", "40 pieces".
std::string in_short(std::string repair) {
    repair.resize(std::min(repair.find(": "), repair.size()));
    for (const std::string_view verb :
         {" welded", " joined into one surface", " closed", " left out", " ignored", " taken off", " made rounder"})
        if (repair.ends_with(verb)) repair.resize(repair.size() - verb.size());
    constexpr std::string_view grown = "the body has grown together with itself";
    if (repair.starts_with(grown)) repair = "grown together" + repair.substr(grown.size());
    return repair;
}

} // namespace

void print_warnings(const std::filesystem::path& file, const KinematicSkeleton<double>& skeleton,
                    const std::vector<std::string>& repairs, Words words) {
    std::string repaired;
    for (const std::string& warning : skeleton.quality.warnings) {
        if (words == Words::few) break;
        if (words == Words::usual && std::find(repairs.begin(), repairs.end(), warning) != repairs.end())
            repaired += (repaired.empty() ? ": repaired: " : ", ") + in_short(warning);
        else
            print_warning(file.string() + ": " + warning);
    }
    if (!repaired.empty()) print_warning(file.string() + repaired);
    if (skeleton.quality.sides_confidence < search::likely_enough)
        print_warning(file.string() + ": the skeleton is a guess: confidence " +
                      std::to_string(skeleton.quality.sides_confidence).substr(0, 4) + "; look at it (render)");
}

} // namespace skelgen::cli
