#include <memory>
#include <optional>

#include <skelgen/applications/pose_transfer.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "fitted_file.hpp"

namespace skelgen::cli {
namespace {

using applications::Floor;

struct PoseCommand {
    MeshInput mesh;
    std::string like; ///< mesh of the body to be held like
    std::string pose; ///< or the skeleton of one
    std::string output;
    int component = 0;
    bool quiet = false;
};

/// The one whose pose is taken.
struct Model {
    KinematicSkeleton<double> skeleton;
    std::optional<Floor<double>> floor; ///< where it is known to stand on one
};

const SkeletonTemplate& human() { return builtin_template("human21"); }

Model load_model(const PoseCommand& command) {
    if (command.like.empty()) {
        return in_file(command.pose, [&] {
            Model model{read_skeleton(command.pose), std::nullopt};
            if (model.skeleton.template_name != human().name)
                throw Error(ErrorCode::bad_input, "is a skeleton of the template " + model.skeleton.template_name +
                                                      "; extract it with human21");
            return model;
        });
    }
    return in_file(command.like, [&] {
        const FittedFile other = fit_file({command.like, {}});
        Model model{other.skeleton(), std::nullopt};
        const Floor<double> floor = applications::floor_of(other.mesh, model.skeleton, human());
        if (floor.is_stood_on) model.floor = floor;
        return model;
    });
}

void run(const PoseCommand& command) {
    require_different_files(command.mesh.file, command.output);
    require_different_files(command.like, command.output);
    require_different_files(command.pose, command.output);
    const auto format = io::mesh_format_of(command.output);
    if (!format || !io::is_written(*format))
        throw Error(ErrorCode::usage, command.output + ": its name must end in " + io::written_mesh_extensions_text());
    const Model model = load_model(command);
    ExtractOptions options;
    options.prepare.component = command.component;
    in_file(command.mesh.file, [&] {
        const FittedFile body = fit_file(command.mesh, options);
        auto posed = applications::pose_like(body.mesh, body.found.body, body.skeleton(), model.skeleton, human());
        if (model.floor) posed = put_on(std::move(posed), *model.floor);
        in_file(command.output, [&] { write_mesh(command.output, posed.mesh); });
        if (!command.quiet) print_warnings(command.mesh.file, body.skeleton());
    });
}

} // namespace

void add_pose_command(CLI::App& app) {
    auto command = std::make_shared<PoseCommand>();
    CLI::App* sub = app.add_subcommand("pose", "Hold a body as another one holds itself");
    add_mesh_input(*sub, command->mesh, "Mesh of one body");
    CLI::Option_group* model = sub->add_option_group("pose", "Whose pose it gets");
    model->add_option("--like", command->like, "Mesh of another body, of any shape and unit");
    model->add_option("--pose", command->pose, "Skeleton of another body, as extract writes it");
    model->require_option(1);
    sub->add_option("-o,--output", command->output, "Mesh to write: " + io::written_mesh_extensions_text())->required();
    sub->add_option("--component", command->component, "Which of several bodies that stand apart; 1 is the largest")
        ->check(CLI::Range(1, 1000));
    sub->add_flag("-q,--quiet", command->quiet, "No warnings");
    sub->footer("Examples:\n  skelgen pose woman.off --like walking_man.ply -o walking_woman.off\n"
                "  skelgen pose character.glb --pose walking.json -o walking.glb");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
