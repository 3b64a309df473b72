#include <map>
#include <memory>
#include <utility>

#include <skelgen/io/rig_formats.hpp>

#include "character.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "fitted_file.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

using applications::Place;
using applications::RestPose;

struct RigCommand {
    MeshInput mesh;
    std::string output;
    std::string names = "skelgen";
    std::string rest; ///< empty: as the format wants it
    std::string place = "keep";
    std::string unit; ///< empty: as the height tells
    io::Credits credits;
    DigitOptions digits;
    BoneOptions bones;
    int component = 0;
    bool quiet = false;
};

const std::map<std::string, RestPose> rest_poses{
    {"as-is", RestPose::as_is}, {"t-pose", RestPose::t_pose}, {"a-pose", RestPose::a_pose}};

const std::map<std::string, Place> places{{"keep", Place::keep}, {"centre", Place::centre}, {"floor", Place::floor}};

/// Metres in each.
const std::map<std::string, double> units{{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};

/// The wanted rest pose; by default as the body is, but for VRM, which knows the T-pose alone.
RestPose rest_pose(const RigCommand& command, io::RigFormat format) {
    const bool is_vrm = format == io::RigFormat::vrm;
    if (command.rest.empty()) return is_vrm ? RestPose::t_pose : RestPose::as_is;
    const RestPose rest = rest_poses.at(command.rest);
    if (is_vrm && rest == RestPose::a_pose)
        throw Error(ErrorCode::usage, "--rest " + command.rest + ": VRM's rest pose is the T-pose; leave it out");
    return rest;
}

void run(const RigCommand& command) {
    require_different_files(command.mesh.file, command.output);
    require_folder_of(command.output);
    const auto format = io::rig_format_of(command.output);
    if (!format) throw Error(ErrorCode::usage, command.output + ": its name must end in .glb, .vrm, .fbx or .bvh");
    const double metres = command.unit.empty() ? 0 : units.at(command.unit);
    const CharacterOptions options{command.component,
                                   {rest_pose(command, *format), places.at(command.place), metres},
                                   command.digits.wanted(),
                                   command.digits.toes};
    Character character = in_file(command.mesh.file, [&] {
        const WaitingLine waiting(command.mesh.file.string(), !command.quiet);
        return make_character(command.mesh, options);
    });
    character.rig = applications::with_engine_bones(std::move(character.rig), command.bones.wanted());
    character.kept.looks = io::with_credits(std::move(character.kept.looks), command.credits);
    in_file(command.output, [&] {
        write_rig(command.output, character.rig, *io::joint_names_named(command.names), character.kept.looks);
    });
    print_warnings(command.mesh.file, character, *format, command.quiet);
}

} // namespace

void add_rig_command(CLI::App& app) {
    auto command = std::make_shared<RigCommand>();
    CLI::App* sub = app.add_subcommand("rig", "Bind the mesh of a body to its skeleton: a character that moves");
    add_mesh_input(*sub, command->mesh, "Mesh of one body");
    sub->add_option("-o,--output", command->output, "Character (.glb, .vrm, .fbx) or skeleton alone (.bvh) to write")
        ->required();
    add_joint_names_option(*sub, command->names, "Whose names the joints get; VRM's own in .vrm");
    sub->add_option("--rest", command->rest, "Pose at rest: as-is, or un-posed (default: as-is; in .vrm t-pose)")
        ->check(CLI::IsMember({"as-is", "t-pose", "a-pose"}));
    sub->add_option("--place", command->place,
                    "Where it is put: keep, where it was in its scene; centre, on the floor with its root above the\n"
                    "origin; floor, moved up or down alone. One that has to be turned upright is put as by centre")
        ->check(CLI::IsMember({"keep", "centre", "floor"}))
        ->capture_default_str();
    sub->add_option("--unit", command->unit, "Unit of the mesh (default: by its height m, cm or mm)")
        ->check(CLI::IsMember({"m", "cm", "mm", "in", "ft"}));
    sub->add_option("--title", command->credits.title, "Name of the character, in place of the input's");
    sub->add_option("--author", command->credits.author, "Who made it, in place of the input's");
    sub->add_option("--license", command->credits.license,
                    "Its licence or that one's address, in place of the input's");
    add_wanted_option(*sub, command->mesh.wanted);
    add_skeleton_options(*sub, command->mesh);
    add_digit_options(*sub, command->digits);
    add_bone_options(*sub, command->bones);
    add_component_option(*sub, command->component);
    sub->add_flag("-q,--quiet", command->quiet, "No warnings but what a licence forbids, and guesses");
    sub->footer("Examples:\n  skelgen rig body.off -o body.glb\n"
                "  skelgen rig scan.ply -o avatar.vrm --title Ada --author 'A. Maker' --license CC0\n"
                "  skelgen rig body.off -o body.glb --rest t-pose --names mixamo\n"
                "  skelgen rig body.off -o body.fbx --bones engine --twist --names unreal");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
