#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/correspondence.hpp>
#include <skelgen/io/coloured_ply.hpp>
#include <skelgen/io/correspondence_json.hpp>

#include "commands.hpp"
#include "compared_file.hpp"
#include "console.hpp"
#include "fitted_inputs.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

struct CorrespondCommand {
    fs::path from;
    int from_component = 0; ///< as `PrepareOptions::component`
    FittedInputs to;
    std::string output = "-";
    std::string ply; ///< folder
    CorrespondenceExtras extras;
};

ComparedFile load(const CorrespondCommand& command) {
    const WaitingLine waiting(command.from.string(), !command.to.quiet);
    ExtractOptions options;
    options.prepare.component = command.from_component;
    return in_file(command.from, [&] {
        MeshInput input{command.from, {}};
        input.wanted = command.to.wanted;
        return compared(fit_file(input, options), command.from_component);
    });
}

/// Each vertex in the colour of its place in the common pose: x red, y green, z blue.
std::vector<io::ByteColour> place_colours(const applications::ComparableBody<double>& body) {
    const Eigen::RowVector3d low = body.common.colwise().minCoeff();
    const Eigen::RowVector3d extent = body.common.colwise().maxCoeff() - low;
    std::vector<io::ByteColour> out;
    for (Eigen::Index v = 0; v < body.common.rows(); ++v) {
        io::ByteColour colour{};
        for (int axis = 0; axis < 3; ++axis)
            colour[static_cast<std::size_t>(axis)] =
                static_cast<std::uint8_t>(40 + 215 * (body.common(v, axis) - low[axis]) / extent[axis]);
        out.push_back(colour);
    }
    return out;
}

/// Where the two bodies go in colours, in a folder.
std::array<fs::path, 2> coloured_files(const fs::path& folder) { return {folder / "from.ply", folder / "to.ply"}; }

void write_coloured(const fs::path& folder, const ComparedFile& from, const ComparedFile& to,
                    const std::vector<int>& to_body_of_from) {
    make_folder(folder);
    const std::vector<io::ByteColour> places = place_colours(to.comparable);
    const auto write = [&](const fs::path& file, const TriangleMesh<double>& mesh, const std::vector<int>& place_of) {
        io::MeshColours colours;
        for (const int place : place_of) colours.vertices.push_back(places[static_cast<std::size_t>(place)]);
        in_file(file, [&] { io::write_coloured_ply(file, mesh, colours); });
    };
    const auto [from_file, to_file] = coloured_files(folder);
    write(from_file, from.file.mesh(), to_body_of_from);
    write(to_file, to.file.mesh(), applications::standing_for(to.file.found.body, to.file.mesh().vertices));
}

/// Where results go, of one body.
struct Outputs {
    std::string json;
    fs::path coloured; ///< folder; empty: none
};

void require_inputs_kept(const CorrespondCommand& command, const BatchItem& to, const Outputs& outputs) {
    std::vector<std::string> files{outputs.json};
    if (!outputs.coloured.empty())
        for (const fs::path& file : coloured_files(outputs.coloured)) files.push_back(file.string());
    for (const std::string& file : files)
        for (const fs::path& input : {command.from, to.mesh}) require_different_files(input, file);
}

void correspond(const CorrespondCommand& command, const ComparedFile& from, const ComparedFile& to,
                const Outputs& outputs) {
    const FoundCorrespondence found = correspondence_of(from.body(), to.body(), command.extras);
    if (!outputs.coloured.empty()) write_coloured(outputs.coloured, from, to, found.to_body_vertex);
    write_result(outputs.json, io::correspondence_to_json(found.file));
}

bool is_folder_name(const std::string& output) { return output.ends_with('/') || fs::is_directory(output); }

void run(const CorrespondCommand& command) {
    const std::vector<BatchItem> items = find_items(command.to, command.output);
    const bool reads_input = std::any_of(items.begin(), items.end(), [](const auto& item) { return item.mesh == "-"; });
    if (command.from == "-" && reads_input)
        throw Error(ErrorCode::usage, "two bodies cannot both come through standard input; name the file of one");
    const bool into_folder = are_many(command.to, items) || is_folder_name(command.output);
    if (into_folder && (command.output == "-" || fs::path(command.output).extension() == ".json"))
        throw Error(ErrorCode::usage, "-o " + command.output + ": several meshes need a folder");
    const auto outputs_of = [&](const BatchItem& item) {
        if (!into_folder) return Outputs{command.output, command.ply};
        if (command.ply.empty()) return Outputs{item.output.string(), {}};
        const fs::path within = fs::path(item.output).replace_extension().lexically_relative(command.output);
        return Outputs{item.output.string(), fs::path(command.ply) / within};
    };
    for (const BatchItem& item : items) require_inputs_kept(command, item, outputs_of(item));
    if (into_folder)
        make_folder(command.output);
    else
        require_folder_of(command.output);
    const ComparedFile from = load(command);
    for_each_fitted(command.to, items, [&](const FittedInput& input) {
        const Outputs outputs = outputs_of(input.item);
        if (into_folder) make_folder(fs::path(outputs.json).parent_path());
        correspond(command, from, in_file(input.item.mesh, [&] { return compared(input, input.item.component); }),
                   outputs);
    });
    print_warnings(command.from, from.file.skeleton(), from.file.found.body.repairs, words_of(command.to.quiet));
}

} // namespace

void add_correspond_command(CLI::App& app) {
    auto command = std::make_shared<CorrespondCommand>();
    CLI::App* sub = app.add_subcommand("correspond", "Find for each vertex of one body the same place on other ones");
    sub->add_option("FROM", command->from, "Mesh of one body, any format that is read; - for standard input")
        ->required();
    sub->add_option("TO", command->to.inputs,
                    "Meshes of other ones, or of the same in other poses; folders of meshes, patterns")
        ->required();
    sub->add_option("-o,--output", command->output,
                    "File to write (JSON): a vertex of TO for each of FROM; a folder for several, with a file for each")
        ->capture_default_str();
    sub->add_option(
           "--ply", command->ply,
           "Folder for both bodies (from.ply, to.ply), like places in like colours; of several TO one for each")
        ->capture_default_str();
    sub->add_flag("--confidence", command->extras.confidence, "Also how sure each vertex's place is, 0 to 1");
    sub->add_flag("--places", command->extras.places,
                  "Also places between vertices: a face of TO for each vertex, and its corners' weights");
    add_wanted_option(*sub, command->to.wanted);
    add_components_option(*sub, command->to.component);
    add_component_option(*sub, command->from_component, "--from-component", "The same of FROM");
    sub->add_flag("-q,--quiet", command->to.quiet, "No warnings but that a skeleton is a guess");
    sub->footer("Examples:\n  skelgen correspond child.ply adult.obj -o map.json --ply coloured/\n"
                "  skelgen correspond template.obj scans/ -o maps/");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
