#include <memory>

#include <skelgen/io/segmentation_json.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "fitted_inputs.hpp"
#include "parts.hpp"

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

struct SegmentCommand {
    FittedInputs inputs;
    std::string output = "-";
    std::string parts = "bones";
};

void write_ply(const fs::path& file, const FittedInput& input, const applications::Segmentation& parts) {
    const io::MeshColours colours{vertex_colours(parts), parts.vertex_part, parts.face_part};
    in_file(file, [&] { io::write_coloured_ply(file, input.mesh(), colours); });
}

std::string json_of(const FittedInput& input, const applications::Segmentation& parts) {
    return io::segmentation_to_json(parts, input.source, input.skeleton().quality);
}

void segment_one(const SegmentCommand& command, const FittedInput& input) {
    require_different_files(input.item.mesh, command.output);
    const applications::Segmentation parts = parts_of(input.found, command.parts);
    if (fs::path(command.output).extension() == ".ply")
        write_ply(command.output, input, parts);
    else
        write_result(command.output, json_of(input, parts));
}

void segment_into_folder(const SegmentCommand& command, const FittedInput& input) {
    const applications::Segmentation parts = parts_of(input.found, command.parts);
    const fs::path json = input.item.output, ply = fs::path(json).replace_extension(".ply");
    require_different_files(input.item.mesh, ply.string());
    make_folder(json.parent_path());
    write_result(json, json_of(input, parts));
    write_ply(ply, input, parts);
}

bool is_file_name(const std::string& output) {
    const fs::path extension = fs::path(output).extension();
    return output == "-" || extension == ".json" || extension == ".ply";
}

void run(const SegmentCommand& command) {
    const std::vector<BatchItem> items = find_items(command.inputs, command.output);
    const bool into_folder = are_many(command.inputs, items) || !is_file_name(command.output);
    if (into_folder && is_file_name(command.output))
        throw Error(ErrorCode::usage, "-o " + command.output + ": several meshes need a folder");
    if (into_folder)
        make_folder(command.output);
    else
        require_folder_of(command.output);
    for_each_fitted(command.inputs, items, [&](const FittedInput& input) {
        if (into_folder)
            segment_into_folder(command, input);
        else
            segment_one(command, input);
    });
}

} // namespace

void add_segment_command(CLI::App& app) {
    auto command = std::make_shared<SegmentCommand>();
    CLI::App* sub = app.add_subcommand("segment", "Divide bodies into their parts, left and right told apart");
    add_fitted_inputs(*sub, command->inputs);
    sub->add_option("-o,--output", command->output,
                    "File to write: .json (a part for each vertex and face) or .ply (coloured, with labels); a folder\n"
                    "gets both for each mesh; - for JSON on standard output")
        ->capture_default_str();
    sub->add_option("--parts", command->parts,
                    "bones: head, neck, chest, abdomen, pelvis, and on each side shoulder, upper_arm, forearm, hand,\n"
                    "thigh, calf, foot; body: head, torso, and the limbs without the shoulder")
        ->check(CLI::IsMember(part_sets))
        ->capture_default_str();
    sub->footer("Examples:\n  skelgen segment body.off -o parts.ply\n  skelgen segment scans/ -o parts/ --parts body");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
