#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/pose_transfer.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/hands/find_hands.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/part_looks.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "character.hpp"
#include "clip_input.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "fitted_file.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

using applications::Floor;

struct PoseCommand {
    MeshInput mesh;
    std::string like; ///< mesh of the body to be held like
    std::string pose; ///< or the skeleton of one
    std::string clip; ///< or a motion, of which one frame is taken
    int frame = 0;
    std::string output;
    int component = 0;
    bool quiet = false;
};

/// The one whose pose is taken.
struct Model {
    KinematicSkeleton<double> skeleton;
    std::optional<Floor<double>> floor;    ///< where it is known to stand on one
    std::vector<std::string> repairs = {}; ///< of its surface
};

/// human21 or, of an animal, quadruped.
const SkeletonTemplate& template_of(const KinematicSkeleton<double>& skeleton) {
    return applications::own_template(skeleton);
}

/// \throws Error bad_input, naming the joint, when one is farther from its parent than in any body.
void require_bones_of_a_body(const KinematicSkeleton<double>& skeleton) {
    // People's longest bone is three times the middle one, those of figures with odd limbs some ten times.
    constexpr double most = 100;
    const auto length_of = [&](const Joint<double>& joint) {
        return joint.parent < 0
                   ? 0.0
                   : (joint.position - skeleton.joints[static_cast<std::size_t>(joint.parent)].position).norm();
    };
    std::vector<double> lengths;
    for (const Joint<double>& joint : skeleton.joints)
        if (const double length = length_of(joint); length > 0) lengths.push_back(length);
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    for (const Joint<double>& joint : skeleton.joints)
        if (length_of(joint) > most * *middle)
            throw Error(ErrorCode::bad_input, "the bone to its joint " + joint.name + " is more than " +
                                                  std::to_string(static_cast<int>(most)) +
                                                  " times as long as the others; write it with `skelgen extract`");
}

/// Whether a file's skeleton says how someone is held. \throws Error bad_input when it does not.
void require_pose(const KinematicSkeleton<double>& skeleton) {
    const SkeletonTemplate& wanted = template_of(skeleton);
    if (skeleton.template_name != wanted.name)
        throw Error(ErrorCode::bad_input,
                    "is a skeleton of the template " + skeleton.template_name +
                        ", which cannot be taken here; extract one of human21, or of an animal quadruped");
    const auto is_same = [](const Joint<double>& joint, const TemplateJoint& known) {
        return joint.name == known.name && joint.parent == known.parent;
    };
    if (!std::equal(skeleton.joints.begin(), skeleton.joints.end(), wanted.joints.begin(), wanted.joints.end(),
                    is_same))
        throw Error(ErrorCode::bad_input,
                    "its joints are not those of the template " + wanted.name + "; write it with `skelgen extract`");
    for (const Joint<double>& joint : skeleton.joints)
        if (!(joint.position.cwiseAbs().maxCoeff() <= std::numeric_limits<float>::max()))
            throw Error(ErrorCode::bad_input, "its joint " + joint.name +
                                                  " has a position that is too large or not finite; " +
                                                  "write it with `skelgen extract`");
    const auto has_length = [&](const Joint<double>& joint) {
        return joint.parent >= 0 && joint.position != skeleton.joints[static_cast<std::size_t>(joint.parent)].position;
    };
    if (std::none_of(skeleton.joints.begin(), skeleton.joints.end(), has_length))
        throw Error(ErrorCode::bad_input, "its bones have no length; write it with `skelgen extract`");
    require_bones_of_a_body(skeleton);
}

Model load_model(const PoseCommand& command) {
    if (command.like.empty()) {
        return in_file(command.pose, [&] {
            Model model{hands::without_digits(read_skeleton(command.pose)), std::nullopt};
            require_pose(model.skeleton);
            return model;
        });
    }
    return in_file(command.like, [&] {
        MeshInput input{command.like, {}};
        input.wanted = command.mesh.wanted;
        const FittedFile other = fit_file(input);
        Model model{other.skeleton(), std::nullopt, other.found.body.repairs};
        const Floor<double> floor = applications::floor_of(other.mesh(), model.skeleton, template_of(model.skeleton));
        if (floor.is_stood_on) model.floor = floor;
        return model;
    });
}

/// A mesh in another pose, and how its vertices have been turned to get there.
struct Held {
    TriangleMesh<double> mesh;
    applications::VertexTurns<double> turns;
};

Held held_like_model(const PoseCommand& command, const FittedFile& body, const Model& model) {
    return in_file(command.mesh.file, [&] {
        const SkeletonTemplate& own = template_of(body.skeleton());
        if (model.skeleton.template_name != own.name)
            throw Error(ErrorCode::usage,
                        "a person cannot take an animal's pose, nor an animal a person's; name two of one kind");
        auto posed = applications::pose_like(body.mesh(), body.found.body, body.skeleton(), model.skeleton, own);
        if (model.floor) posed = put_on(std::move(posed), *model.floor);
        return Held{std::move(posed.mesh), std::move(posed.turns)};
    });
}

/// The clip, in which the frame is.
ClipInput load_posing_clip(const PoseCommand& command) {
    ClipInput input = load_clip(command.clip);
    if (command.frame >= input.clip.frames.rows())
        throw Error(ErrorCode::usage, command.clip + ": has no frame " + std::to_string(command.frame) + ", but " +
                                          std::to_string(input.clip.frames.rows()) + ", counted from 0");
    return input;
}

/// The body as the clip's skeleton is in the frame: +y up, on the floor, in the mesh's unit.
Held held_as_in_clip(const PoseCommand& command, const FittedFile& body, const ClipInput& clip) {
    const auto rig = in_file(command.mesh.file, [&] {
        return applications::make_rig(body.mesh(), body.found.body, body.skeleton(), template_of(body.skeleton()));
    });
    const auto animation = follow_clip(clip, rig); // all of it: its floor is that of all frames
    const auto& pose = animation.frames[static_cast<std::size_t>(command.frame)];
    Held held{posed(rig, pose), applications::skin_turns(rig.skin, motions(rig.joints, pose))};
    held.mesh.vertices /= rig.metres_per_unit;
    for (std::size_t v = 0; v < held.turns.size(); ++v) held.turns[v] = held.turns[v] * rig.turns[v];
    return held;
}

void run(const PoseCommand& command) {
    require_different_files(command.mesh.file, command.output);
    require_folder_of(command.output);
    for (const std::string& file : {command.like, command.pose, command.clip})
        require_different_files(file, command.output);
    const auto format = io::mesh_format_of(command.output);
    if (!format || !io::is_written(*format))
        throw Error(ErrorCode::usage, command.output + ": its name must end in " + io::written_mesh_extensions_text());
    WaitingLine waiting(command.mesh.file.string(), !command.quiet);
    std::optional<Model> model;
    std::optional<ClipInput> clip;
    if (command.clip.empty())
        model = load_model(command);
    else
        clip = load_posing_clip(command);
    ExtractOptions options;
    options.prepare.component = command.component;
    FittedFile body = in_file(command.mesh.file, [&] { return fit_file(command.mesh, options); });
    if (command.component > 0) body = with_own_part(std::move(body));
    const Held held = model ? held_like_model(command, body, *model) : held_as_in_clip(command, body, *clip);
    const KeptLooks kept = keep_looks(command.mesh);
    in_file(command.output,
            [&] { io::write_mesh(command.output, held.mesh, io::looks_of(kept.looks, body.part), held.turns); });
    waiting.end();
    print_forbidden(command.mesh.file, kept.looks);
    const Words words = words_of(command.quiet);
    if (model)
        print_warnings(command.like.empty() ? command.pose : command.like, model->skeleton, model->repairs, words);
    print_warnings(command.mesh.file, body.skeleton(), body.found.body.repairs, words);
    if (command.quiet) return;
    print_lost_looks(command.mesh.file, kept, *format);
}

} // namespace

void add_pose_command(CLI::App& app) {
    auto command = std::make_shared<PoseCommand>();
    CLI::App* sub = app.add_subcommand("pose", "Hold a body as another one holds itself");
    add_mesh_input(*sub, command->mesh, "Mesh of one body");
    CLI::Option_group* model = sub->add_option_group("pose", "Whose pose it gets");
    model->add_option("--like", command->like, "Mesh of another body, of any shape and unit");
    model->add_option("--pose", command->pose, "Skeleton of another body, as extract writes it");
    CLI::Option* clip = model->add_option("--clip,--bvh", command->clip, "Motion of a skeleton, as animate takes it");
    model->require_option(1);
    sub->add_option("--frame", command->frame, "Which of the motion's frames, counted from 0")
        ->needs(clip)
        ->check(CLI::Range(0, std::numeric_limits<int>::max()))
        ->capture_default_str();
    sub->add_option("-o,--output", command->output, "Mesh to write: " + io::written_mesh_extensions_text())->required();
    add_component_option(*sub, command->component);
    add_wanted_option(*sub, command->mesh.wanted);
    add_skeleton_options(*sub, command->mesh);
    sub->add_flag("-q,--quiet", command->quiet, "No warnings but what a licence forbids, and guesses");
    sub->footer("Examples:\n  skelgen pose woman.off --like walking_man.ply -o walking_woman.off\n"
                "  skelgen pose character.glb --pose walking.json -o walking.glb\n"
                "  skelgen pose scan.ply --bvh dance.bvh --frame 120 -o dancing.ply");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
