#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <memory>
#include <tuple>

#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/render/contact_sheet.hpp>
#include <skelgen/render/png.hpp>
#include <skelgen/render/render_scene.hpp>

#include "batch_inputs.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "extract_file.hpp"
#include "load_scene.hpp"
#include "progress_bar.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

struct RenderCommand {
    std::vector<std::string> inputs;
    std::string output = "-";
    std::string view = "front";
    std::string size; ///< empty: 800x1000, or 320x400 for each picture of a sheet
    std::string background = "white";
    std::string skeleton_template = "human21";
    std::string skeleton;
    std::string curve;
    std::string truth;
    std::string parts;
    int columns = 0; ///< 0: as many as make the sheet most nearly square
    bool names = false;
};

bool is_svg(const std::string& output) { return fs::path(output).extension() == ".svg"; }

void check_output(const std::string& output) {
    if (output == "-") {
        if (isatty(STDOUT_FILENO) != 0)
            throw Error(ErrorCode::usage,
                        "standard output: is a terminal, which cannot show a PNG; name a file with -o");
        return;
    }
    if (!is_svg(output) && fs::path(output).extension() != ".png")
        throw Error(ErrorCode::usage, output + ": is neither .png nor .svg; choose one of the two");
}

std::pair<int, int> parse_size(const std::string& text) {
    const char* const end = text.data() + text.size();
    int width = 0;
    int height = 0;
    const auto [cross, first] = std::from_chars(text.data(), end, width);
    if (first == std::errc() && cross != end && *cross == 'x') {
        const auto [rest, second] = std::from_chars(cross + 1, end, height);
        if (second == std::errc() && rest == end) return {width, height};
    }
    throw Error(ErrorCode::usage, "--size: '" + text + "' is no size; write width x height in pixels, as 800x1000");
}

render::RenderOptions render_options(const RenderCommand& command, bool sheet) {
    render::RenderOptions options;
    const std::string usual_size = sheet ? "320x400" : "800x1000";
    std::tie(options.width, options.height) = parse_size(command.size.empty() ? usual_size : command.size);
    options.view = in_file("--view", [&] { return render::parse_view(command.view); });
    options.background =
        command.background == "transparent" ? render::Background::transparent : render::Background::white;
    options.names = command.names;
    return options;
}

/// The file that belongs to a mesh: the one that was named, or the mesh's own in the folder that was named, which a
/// batch may have given its mesh's extension besides its own.
fs::path companion(const std::string& named, const BatchItem& item) {
    if (named.empty() || !fs::is_directory(named)) return named;
    const fs::path own = fs::path(named) / item.output;
    return fs::exists(own) ? own
                           : fs::path(own).replace_filename(io::without_extensions(item.mesh.filename()) += ".json");
}

/// As `companion`, for a curve: in a folder the first that is there of the formats that are read.
fs::path curve_companion(const std::string& named, const BatchItem& item) {
    const fs::path usual = companion(named, item);
    if (named.empty() || !fs::is_directory(named)) return usual;
    for (const std::string_view extension : io::curve_extensions()) {
        const fs::path found = fs::path(usual).replace_extension(extension);
        if (fs::exists(found)) return found;
    }
    return usual;
}

ExtractOptions extract_options(const RenderCommand& command) {
    ExtractOptions options;
    want_template(options, command.skeleton_template);
    return options;
}

SceneSources sources_of(const RenderCommand& command, const BatchItem& item, const ExtractOptions& options) {
    return {item.mesh,
            companion(command.skeleton, item),
            curve_companion(command.curve, item),
            companion(command.truth, item),
            options,
            command.parts,
            !command.skeleton.empty() && fs::is_directory(command.skeleton)};
}

// ---- one mesh ----

void render_one(const RenderCommand& command, const BatchItem& item) {
    if (!item.fault.empty()) throw Error(ErrorCode::bad_input, item.mesh.string() + ": " + item.fault);
    require_different_files(item.mesh, command.output);
    const render::RenderOptions options = render_options(command, false);
    const render::Scene scene = [&] {
        const WaitingLine waiting(item.mesh.string(), true);
        return load_scene(sources_of(command, item, extract_options(command)));
    }();
    if (!scene.failure.empty()) print_warning(item.mesh.string() + ": " + scene.failure);
    write_result(command.output, in_file(item.mesh, [&] {
                     return is_svg(command.output) ? render::render_svg(scene, options)
                                                   : render::encode_png(render::render_scene(scene, options));
                 }));
}

// ---- a contact sheet ----

struct Cell {
    render::Scene scene;
    bool is_readable = false;
};

/// What cannot be read costs its own cell only.
Cell load_cell(const SceneSources& sources, const BatchItem& item) {
    Cell cell;
    try {
        if (!item.fault.empty()) throw Error(ErrorCode::bad_input, item.mesh.string() + ": " + item.fault);
        cell = {load_scene(sources), true};
        if (!cell.scene.failure.empty()) print_warning(item.mesh.string() + ": " + cell.scene.failure);
    } catch (const Error& error) {
        print_error(error.what());
        const std::string prefix = item.mesh.string() + ": "; // the caption names the mesh already
        const std::string what = error.what();
        cell.scene.failure = what.rfind(prefix, 0) == 0 ? what.substr(prefix.size()) : what;
    }
    cell.scene.caption = item.file;
    return cell;
}

void check_companions(const RenderCommand& command) {
    for (const std::string& named : {command.skeleton, command.curve, command.truth})
        if (!named.empty() && !fs::is_directory(named))
            throw Error(ErrorCode::usage, named + ": is no folder; several meshes need a folder with a file for each");
}

void render_sheet(const RenderCommand& command, const std::vector<BatchItem>& items) {
    check_companions(command);
    const render::RenderOptions options = render_options(command, true);
    const ExtractOptions extraction = extract_options(command);
    const bool svg = is_svg(command.output);
    std::vector<render::Image> images;
    std::vector<std::string> documents;
    std::size_t done = 0, failed = 0;
    ProgressBar bar(items.size(), true, patience_seconds);
    for (const BatchItem& item : items) {
        require_different_files(item.mesh, command.output);
        const Cell cell = load_cell(sources_of(command, item, extraction), item);
        failed += cell.is_readable ? 0 : 1;
        if (svg)
            documents.push_back(render::render_svg(cell.scene, options));
        else
            images.push_back(render::render_scene(cell.scene, options));
        bar.show(++done, failed);
    }
    bar.clear();
    const int count = static_cast<int>(items.size());
    const int columns =
        command.columns > 0 ? command.columns : render::sheet_columns(count, options.width, options.height);
    write_result(command.output, svg ? render::svg_contact_sheet(documents, columns, options.width, options.height)
                                     : render::encode_png(render::contact_sheet(images, columns)));
    if (failed > 0) throw CLI::RuntimeError(status_some_failed);
}

void run(const RenderCommand& command) {
    check_output(command.output);
    require_folder_of(command.output);
    const std::vector<BatchItem> items = find_batch_items(command.inputs, {});
    const bool sheet = items.size() > 1 || fs::is_directory(command.inputs.front());
    if (sheet)
        render_sheet(command, items);
    else
        render_one(command, items.front());
}

void add_source_options(CLI::App& sub, RenderCommand& command) {
    sub.add_option(
        "--skeleton", command.skeleton,
        "Show this skeleton file instead of extracting; several meshes: a folder of them, in which those of bodies\n"
        "that have none may be missing: their curves are shown");
    sub.add_option("--curve", command.curve,
                   "Show this curve file (.json, .obj, .ply or .swc); several meshes: a folder of them");
    sub.add_option("--truth", command.truth,
                   "Mark the joints of this file (JSON, \"joints\": {name: [x, y, z]}) by red crosses; or a folder");
    sub.add_option("--parts", command.parts,
                   "Instead of a skeleton show the parts of the body, each in its colour: bones or body, as `segment`")
        ->check(CLI::IsMember({"bones", "body"}));
    sub.add_option(
           "--template", command.skeleton_template,
           "Built-in template (human21, pinocchio18, quadruped), auto for a person or a four-legged animal, or a "
           "template's file (JSON)")
        ->capture_default_str();
}

void add_picture_options(CLI::App& sub, RenderCommand& command) {
    sub.add_option("--view", command.view,
                   "front, back, side, top, three-quarter, or a direction towards the viewer as x,y,z")
        ->capture_default_str();
    sub.add_option("--size", command.size,
                   "Width x height in pixels, of each picture in a sheet; 800x1000 if not given, 320x400 in a sheet");
    sub.add_option("--background", command.background, "white or transparent")
        ->check(CLI::IsMember({"white", "transparent"}))
        ->capture_default_str();
    sub.add_option("--columns", command.columns, "Columns of a contact sheet; as square as it gets if not given")
        ->check(CLI::Range(1, 1000));
    sub.add_flag("--names", command.names, "Write the joints' names");
}

} // namespace

void add_render_command(CLI::App& app) {
    auto command = std::make_shared<RenderCommand>();
    CLI::App* sub = app.add_subcommand("render", "Draw a body with its skeleton inside; several as a contact sheet");
    sub->add_option("MESH", command->inputs, "Meshes, folders of meshes, patterns; more than one make a contact sheet")
        ->required();
    sub->add_option("-o,--output", command->output, "Picture to write: .png or .svg; - for a PNG on standard output")
        ->capture_default_str();
    add_picture_options(*sub, *command);
    add_source_options(*sub, *command);
    sub->footer("Example:\n  skelgen render body.off -o body.png --view three-quarter --names\n"
                "  skelgen render scans/ -o sheet.png");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
