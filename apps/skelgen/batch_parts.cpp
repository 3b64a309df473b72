#include "batch_parts.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <utility>

#include <skelgen/applications/alignment.hpp>
#include <skelgen/applications/measurement.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/applications/segmentation.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/measurements_text.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/io/segmentation_json.hpp>
#include <skelgen/io/transform_json.hpp>

#include "character.hpp"
#include "console.hpp"
#include "parts.hpp"

#if SKELGEN_WITH_RENDER
#include <skelgen/render/png.hpp>
#include <skelgen/render/render_scene.hpp>
#endif

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

/// What a part's file holds, as bytes, and what is to be said of it.
struct PartContent {
    std::string bytes;
    std::string warning = {}; ///< empty: none
};

using Format = PartContent (*)(const BatchItem&, const FittedFile&, const PartContext&);

PartContent rig_content(const BatchItem& item, const FittedFile& body, const PartContext& context) {
    const auto rig = rig_of(body.mesh(), body.found, context.skeleton_template,
                            {applications::RestPose::as_is, applications::Place::keep}, Fingers::automatic);
    KeptLooks kept = keep_looks({item.mesh, {}});
    const auto also = [&](const std::string& what) { kept.warning += (kept.warning.empty() ? "" : "; ") + what; };
    if (!kept.looks.forbidden.empty()) also("ITS LICENCE FORBIDS " + kept.looks.forbidden);
    if (const std::string lost = left_out_text(io::RigFormat::glb, kept.looks); !lost.empty()) also(lost);
    return {io::rig_to_glb(rig, io::JointNames::skelgen, kept.looks), std::move(kept.warning)};
}

PartContent segmentation_content(const BatchItem&, const FittedFile& body, const PartContext&) {
    return {io::segmentation_to_json(parts_of(body.found, "bones"), body.source, body.skeleton().quality)};
}

PartContent measurements_content(const BatchItem& item, const FittedFile& body, const PartContext&) {
    io::SourceMesh source = body.source;
    source.file = item.file;
    const auto parts = applications::segment(body.found.body, body.skeleton());
    return {io::measurements_to_json(
        {{source, body.skeleton().quality, applications::measure(body.found.body, body.skeleton(), parts)}})};
}

PartContent transform_content(const BatchItem&, const FittedFile& body, const PartContext&) {
    return {io::transform_to_json(applications::alignment(body.found.body, body.skeleton(), body.mesh().vertices))};
}

PartContent curve_content(const BatchItem&, const FittedFile& body, const PartContext&) {
    return {io::curve_to_json(body.found.curve)};
}

PartContent correspondence_content(const BatchItem&, const FittedFile& body, const PartContext& context) {
    const ComparedFile to = compared(body);
    return {io::correspondence_to_json(correspondence_of(context.template_body->body(), to.body(), {true, true}).file)};
}

#if SKELGEN_WITH_RENDER
std::string picture(const render::Scene& scene) {
    render::RenderOptions options;
    options.width = 320, options.height = 400; // as in contact sheets
    return render::encode_png(render::render_scene(scene, options));
}

PartContent picture_content(const BatchItem&, const FittedFile& body, const PartContext&) {
    render::Scene scene;
    scene.mesh = body.mesh();
    scene.skeleton = body.skeleton();
    scene.curve = body.found.curve;
    return {picture(scene)};
}
#endif

struct Part {
    std::string_view name;
    std::string_view extension;
    std::string_view what; ///< for the help
    Format format;
    bool has_curve = false;
};

constexpr std::array parts {
    Part{"rig", ".glb", "the character", rig_content},
        Part{"segment", ".segmentation.json", "a part for each vertex and face", segmentation_content},
        Part{"measure", ".measurements.json", "height, bones, girths, volume", measurements_content},
        Part{"align", ".transform.json", "the 4x4 that has it face +Z", transform_content},
        Part{"curve", ".curve.json", "the curve skeleton", curve_content, true},
        Part{"correspond", ".correspondence.json",
             "for each vertex of --template-body its place on the mesh, and how sure it is", correspondence_content},
#if SKELGEN_WITH_RENDER
        Part{"render", ".png", "a picture", picture_content, true},
#endif
};

const Part& find_part(std::string_view name) {
    const auto* const found =
        std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.name == name; });
    if (found != parts.end()) return *found;
    std::string names;
    for (const Part& part : parts) names += (names.empty() ? "" : ", ") + std::string(part.name);
    throw Error(ErrorCode::usage, "--also: '" + std::string(name) + "' is none of " + names);
}

} // namespace

const std::vector<std::string>& batch_part_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        all.reserve(parts.size());
        for (const Part& part : parts) all.emplace_back(part.name);
        return all;
    }();
    return names;
}

std::string batch_parts_text() {
    std::string text;
    for (const Part& part : parts)
        text += (text.empty() ? "" : "; ") + std::string(part.name) + " (" + std::string(part.extension) + ": " +
                std::string(part.what) + ")";
    return text;
}

std::vector<std::string> parse_batch_parts(const std::string& text) {
    std::vector<std::string> names;
    std::istringstream words(text);
    for (std::string name; std::getline(words, name, ',');) {
        static_cast<void>(find_part(name)); // there it is
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

bool part_has_curve(std::string_view part) { return find_part(part).has_curve; }

fs::path part_file(const BatchItem& item, std::string_view part) {
    const fs::path within = item.output.lexically_relative(item.folder.empty() ? "." : item.folder);
    return item.folder / part / fs::path(within).replace_extension(find_part(part).extension);
}

void require_own_files(const std::vector<BatchItem>& items, const std::vector<std::string>& names,
                       const std::vector<fs::path>& others) {
    if (names.empty() && others.empty()) return; // to look up the places of a million meshes takes a minute
    std::set<fs::path> meshes, results;
    for (const BatchItem& item : items) {
        meshes.insert(place_of(item.mesh));
        results.insert(place_of(item.output));
    }
    for (const BatchItem& item : items)
        for (const std::string& part : names) {
            const fs::path file = part_file(item, part);
            if (meshes.contains(place_of(file)))
                throw Error(ErrorCode::usage, file.string() + ": is a mesh that --also " + part +
                                                  " would replace; choose another folder with -o");
            if (!results.insert(place_of(file)).second)
                throw Error(
                    ErrorCode::usage,
                    file.string() +
                        ": would be written twice; give the meshes names that differ in more than their endings");
        }
    for (const fs::path& file : others)
        if (!results.insert(place_of(file)).second)
            throw Error(ErrorCode::usage, file.string() + ": is a result of the batch; choose another file");
}

std::string write_part(std::string_view part, const BatchItem& item, const FittedFile& body,
                       const PartContext& context) {
    PartContent content = in_file(item.mesh, [&] { return find_part(part).format(item, body, context); });
    const fs::path file = part_file(item, part);
    make_folder(file.parent_path());
    in_file(file, [&] { io::write_file_atomically(file, content.bytes); });
    return std::move(content.warning);
}

#if SKELGEN_WITH_RENDER
void draw_refused(const BatchItem& item, const std::string& reason) {
    const std::string text = in_file(item.mesh, [&] {
        render::Scene scene;
        scene.mesh = load_mesh({item.mesh, {}});
        scene.failure = reason;
        return picture(scene);
    });
    const fs::path file = part_file(item, "render");
    make_folder(file.parent_path());
    in_file(file, [&] { io::write_file_atomically(file, text); });
}
#else
void draw_refused(const BatchItem&, const std::string&) {}
#endif

} // namespace skelgen::cli
