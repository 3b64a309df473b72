#include "load_scene.hpp"

#include <fstream>

#include <nlohmann/json.hpp>

#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/skeleton_json.hpp>

#include "console.hpp"

namespace skelgen::cli {
namespace {

std::vector<Mark> read_marks(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(ErrorCode::bad_input, "cannot be opened; check the file's name and permissions");
    std::vector<Mark> marks;
    try {
        const auto document = nlohmann::ordered_json::parse(file);
        for (const auto& [name, position] : document.at("joints").items()) {
            const auto p = position.get<std::array<double, 3>>();
            marks.push_back({name, {p[0], p[1], p[2]}});
        }
    } catch (const nlohmann::json::exception& error) {
        throw Error(ErrorCode::bad_input,
                    std::string("is not JSON with \"joints\": {name: [x, y, z]}: ") + error.what());
    }
    return marks;
}

/// Extracts skeleton and curve into the scene, or says there why not.
void extract_into(Scene& scene, const ExtractOptions& options) {
    try {
        Extraction<double> extraction = extract_skeleton(scene.mesh, options);
        scene.skeleton = std::move(extraction.skeleton);
        scene.curve = std::move(extraction.curve);
        return;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_skeleton && error.code() != ErrorCode::bad_input) throw;
        scene.failure = std::string("no skeleton: ") + error.what();
    }
    try {
        scene.curve = find_curve_skeleton(scene.mesh, options);
    } catch (const Error&) {
        // The failure that the picture names is the one that matters; without a curve it shows the mesh alone.
    }
}

} // namespace

Scene load_scene(const SceneSources& sources) {
    Scene scene;
    scene.mesh = in_file(sources.mesh, [&] { return read_mesh<double>(sources.mesh); });
    if (sources.skeleton.empty())
        in_file(sources.mesh, [&] { extract_into(scene, sources.extraction); });
    else
        scene.skeleton = in_file(sources.skeleton, [&] { return read_skeleton(sources.skeleton); });
    if (!sources.curve.empty()) scene.curve = in_file(sources.curve, [&] { return read_curve(sources.curve); });
    if (!sources.truth.empty()) scene.marks = in_file(sources.truth, [&] { return read_marks(sources.truth); });
    return scene;
}

} // namespace skelgen::cli
