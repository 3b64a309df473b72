#include "load_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/truth_json.hpp>

#include "console.hpp"
#include "mesh_input.hpp"
#include "parts.hpp"

namespace skelgen::cli {
namespace {

std::vector<render::Mark> read_marks(const std::filesystem::path& path) {
    std::vector<render::Mark> marks;
    for (const auto& [name, position] : io::read_true_joints(path)) marks.push_back({name, position});
    return marks;
}

/// Extracts the curve into the scene.
void extract_curve_into(render::Scene& scene, const ExtractOptions& options) {
    try {
        scene.curve = find_curve_skeleton(scene.mesh, options);
    } catch (const Error& error) {
        // No usable surface: the picture says so already, and shows the mesh alone.
        if (error.code() != ErrorCode::bad_input) throw;
    }
}

/// Gives the mesh the colours of its parts, or says in the scene why not.
void colour_parts(render::Scene& scene, const std::string& parts, ExtractOptions options) {
    options.with_curve = false;
    try {
        scene.colours = vertex_colours(parts_of(extract(scene.mesh, options), parts));
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_skeleton && error.code() != ErrorCode::bad_input) throw;
        scene.failure = std::string("no parts: ") + error.what();
    }
}

/// How bright a channel of light is shown, 0 to 255: sRGB.
std::uint8_t shown_byte(float light) {
    constexpr float knee = 0.0031308F, slope = 12.92F, offset = 0.055F, power = 2.4F;
    const float shown = light <= knee ? slope * light : (1 + offset) * std::pow(light, 1 / power) - offset;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(shown, 0.0F, 1.0F)));
}

/// The colours of the file's vertices, where it has such and nothing else that the body would be painted with.
std::vector<io::ByteColour> own_colours(const std::filesystem::path& mesh, Eigen::Index vertices) {
    const io::SceneLooks looks = keep_looks({mesh, {.isolated = true}}).looks;
    if (looks.parts.size() != 1 || !looks.pictures.empty() || looks.parts.front().colours.rows() < vertices) return {};
    std::vector<io::ByteColour> out;
    for (Eigen::Index v = 0; v < vertices; ++v) {
        const auto& light = looks.parts.front().colours.row(v);
        out.push_back({shown_byte(light[0]), shown_byte(light[1]), shown_byte(light[2])});
    }
    return out;
}

/// Extracts skeleton and curve into the scene, or says there why not.
void extract_into(render::Scene& scene, const ExtractOptions& options) {
    try {
        Extraction<double> extraction = extract(scene.mesh, options);
        scene.skeleton = std::move(extraction.skeleton);
        scene.curve = std::move(extraction.curve);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_skeleton && error.code() != ErrorCode::bad_input) throw;
        scene.failure = std::string("no skeleton: ") + error.what();
        extract_curve_into(scene, options);
    }
}

bool is_missing(const SceneSources& sources) {
    return sources.skeleton_may_be_missing && !std::filesystem::exists(sources.skeleton);
}

} // namespace

render::Scene load_scene(const SceneSources& sources) {
    render::Scene scene;
    scene.mesh = in_file(sources.mesh, [&] { return read_mesh<double>(sources.mesh, {.isolated = true}); });
    if (!sources.parts.empty()) {
        in_file(sources.mesh, [&] { colour_parts(scene, sources.parts, sources.extraction); });
        return scene;
    }
    scene.colours = own_colours(sources.mesh, scene.mesh.vertices.rows());
    if (sources.skeleton.empty())
        in_file(sources.mesh, [&] { extract_into(scene, sources.extraction); });
    else if (is_missing(sources)) {
        scene.failure = "no skeleton: there is no file " + sources.skeleton.string();
        if (sources.curve.empty()) in_file(sources.mesh, [&] { extract_curve_into(scene, sources.extraction); });
    } else
        scene.skeleton = in_file(sources.skeleton, [&] { return read_skeleton(sources.skeleton); });
    if (!sources.curve.empty()) scene.curve = in_file(sources.curve, [&] { return read_curve(sources.curve); });
    if (!sources.truth.empty()) scene.marks = in_file(sources.truth, [&] { return read_marks(sources.truth); });
    return scene;
}

} // namespace skelgen::cli
