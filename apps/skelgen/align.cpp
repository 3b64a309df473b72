#include <memory>
#include <utility>

#include <skelgen/applications/alignment.hpp>
#include <skelgen/applications/measurement.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/transform_json.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "fitted_inputs.hpp"

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

struct AlignCommand {
    FittedInputs inputs;
    std::string output;
    std::string origin = "crotch";
    bool to_unit_height = false;
};

/// Where the aligned mesh goes: as its input is called, in a format that is written.
fs::path aligned_file(const AlignCommand& command, const BatchItem& item) {
    const bool is_one_of_several = command.inputs.component == all_components && item.component > 0;
    const fs::path name = is_one_of_several ? fs::path(item.output).replace_extension(item.mesh.extension())
                                            : fs::path(item.output).replace_filename(item.mesh.filename());
    const auto format = io::mesh_format_of(name);
    if (format && io::is_written(*format)) return name;
    return fs::path(item.output).replace_extension(".glb");
}

void align(const AlignCommand& command, FittedInput input) {
    if (input.item.component > 0) static_cast<FittedFile&>(input) = with_own_part(std::move(input));
    const KinematicSkeleton<double>& skeleton = input.skeleton();
    applications::AlignmentOptions options;
    if (command.origin == "floor") options.origin = applications::AlignedOrigin::floor;
    if (command.to_unit_height) options.scale = 1 / applications::standing_height(input.found.body, skeleton);
    const Eigen::Matrix4d transform =
        applications::alignment(input.found.body, skeleton, input.mesh().vertices, options);
    const fs::path mesh_file = aligned_file(command, input.item);
    require_different_files(input.item.mesh, mesh_file.string());
    make_folder(mesh_file.parent_path());
    in_file(mesh_file, [&] {
        write_mesh(mesh_file, TriangleMesh<double>{applications::transformed(input.mesh().vertices, transform),
                                                   input.mesh().faces});
    });
    write_result(fs::path(input.item.output).replace_extension(".transform.json"), io::transform_to_json(transform));
}

void run(const AlignCommand& command) {
    const std::vector<BatchItem> items = find_items(command.inputs, command.output);
    make_folder(command.output);
    for_each_fitted(command.inputs, items, [&](const FittedInput& input) { align(command, input); });
}

} // namespace

void add_align_command(CLI::App& app) {
    auto command = std::make_shared<AlignCommand>();
    CLI::App* sub = app.add_subcommand("align", "Turn bodies so that all face the same way: +Y up, facing +Z");
    add_fitted_inputs(*sub, command->inputs);
    sub->add_option("-o,--output", command->output,
                    "Folder for the aligned meshes, and beside each its 4x4: <name>.transform.json")
        ->required();
    sub->add_option("--origin", command->origin, "crotch: in the joint; floor: below it, as low as the lowest vertex")
        ->check(CLI::IsMember({"crotch", "floor"}))
        ->capture_default_str();
    sub->add_flag("--scale", command->to_unit_height, "Scale bodies so that they are 1 high when they stand upright");
    sub->footer("Example:\n  skelgen align scans/ -o aligned/ --origin floor");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
