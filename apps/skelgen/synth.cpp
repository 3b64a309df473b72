#include <filesystem>
#include <memory>

#include <skelgen/core/error.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/read_file.hpp>
#include <skelgen/io/write_mesh.hpp>
#include <skelgen/synth/body.hpp>
#include <skelgen/synth/garment.hpp>
#include <skelgen/synth/objects.hpp>
#include <skelgen/synth/quadrupeds.hpp>
#include <skelgen/synth/sets.hpp>
#include <skelgen/synth/tubes.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "progress_bar.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

constexpr const char* object_set = "not-a-body";
constexpr const char* tube_set = "tubes";
constexpr const char* quadruped_set = "quadrupeds";

struct SynthCommand {
    std::string output;
    std::string truth;
    std::string pose = "a";
    std::string sex;
    std::string set;
    std::vector<std::string> clothes;
    synth::BodyShape shape;
    std::uint64_t seed = 0;
    int faces = 13776;
};

void set_sex(synth::BodyShape& shape, const std::string& sex) {
    if (sex == "female")
        shape.masculinity = 0;
    else if (sex == "male")
        shape.masculinity = 1;
    else if (!sex.empty())
        throw Error(ErrorCode::usage, "--sex " + sex + " is unknown: give female or male, or --masculinity");
}

/// A random pose, one from a file or one of the library, for which the limbs are spread as far as this body needs.
synth::BodyPose find_pose(const SynthCommand& command) {
    if (command.pose == "random") return synth::random_free_pose(command.shape, command.seed);
    if (std::filesystem::is_regular_file(command.pose))
        return in_file(command.pose, [&] { return synth::parse_pose(io::read_file(command.pose)); });
    return synth::spread_limbs(command.shape, synth::named_pose(command.pose));
}

/// Where a set goes: DIR/meshes/<set>/<name>.off and DIR/truth/<set>/<name>.json.
class SetWriter {
public:
    SetWriter(const std::filesystem::path& folder, std::string set)
        : meshes_(folder / "meshes" / set), truths_(folder / "truth" / set), set_(std::move(set)) {
        make_folder(folder);
        make_folder(meshes_);
        make_folder(truths_);
    }

    /// `to_truth` makes the truth's JSON from the name of the mesh's file.
    template <typename ToTruth>
    void write(const std::string& name, const TriangleMesh<double>& mesh, const ToTruth& to_truth) const {
        const std::filesystem::path mesh_file = meshes_ / (name + ".off"), truth_file = truths_ / (name + ".json");
        in_file(mesh_file, [&] { write_mesh(mesh_file, mesh); });
        write_result(truth_file, to_truth(set_ + "/" + name + ".off"));
    }

private:
    std::filesystem::path meshes_, truths_;
    std::string set_;
};

/// Makes each of the plans and writes it: `make` is given a plan and the writer.
template <typename Plan, typename Make>
void write_each(const SynthCommand& command, const std::vector<Plan>& plans, const Make& make) {
    const SetWriter writer(command.output, command.set);
    std::size_t done = 0;
    ProgressBar bar(plans.size(), true, patience_seconds);
    for (const Plan& plan : plans) {
        make(plan, writer);
        bar.show(++done, 0);
    }
}

void run_objects(const SynthCommand& command) {
    write_each(command, synth::object_names(), [&](const std::string& name, const SetWriter& writer) {
        writer.write(name, synth::synthesize_object(name, command.faces), synth::object_truth_to_json);
    });
}

void run_tubes(const SynthCommand& command) {
    write_each(command, synth::tube_plans(command.seed), [](const synth::TubePlan& plan, const SetWriter& writer) {
        const synth::SynthTube tube = in_file(plan.name, [&] { return synth::synthesize_tube(plan, plan.faces); });
        writer.write(plan.name, tube.mesh,
                     [&](const std::string& file) { return synth::curve_truth_to_json(tube.truth, file); });
    });
}

void run_quadrupeds(const SynthCommand& command) {
    write_each(
        command, synth::quadruped_plans(command.seed), [&](const synth::QuadrupedPlan& plan, const SetWriter& writer) {
            const std::string& name = plan.body.name;
            const TriangleMesh<double> mesh =
                in_file(name, [&] { return synth::synthesize_quadruped(plan, command.faces); });
            writer.write(name, mesh,
                         [&](const std::string& file) { return synth::quadruped_truth_to_json(plan, mesh, file); });
        });
}

void run_set(const SynthCommand& command) {
    if (command.set == object_set) return run_objects(command);
    if (command.set == tube_set) return run_tubes(command);
    if (command.set == quadruped_set) return run_quadrupeds(command);
    write_each(command, synth::body_set(command.set, command.seed),
               [](const synth::BodyPlan& plan, const SetWriter& writer) {
                   const synth::SynthBody body = in_file(plan.name, [&] { return synth::synthesize_body(plan); });
                   writer.write(plan.name, body.mesh,
                                [&](const std::string& file) { return synth::truth_to_json(body.truth, file); });
               });
}

void run(SynthCommand& command) {
    if (!command.set.empty()) return run_set(command);
    set_sex(command.shape, command.sex);
    synth::check_shape(command.shape);
    synth::BodyPlan plan;
    plan.shape = command.shape, plan.pose = find_pose(command), plan.faces = command.faces;
    for (const std::string& garment : command.clothes) plan.clothes.push_back(synth::named_garment(garment));
    const synth::SynthBody body = [&] {
        const WaitingLine waiting(command.output, true);
        return synth::synthesize_body(plan);
    }();
    in_file(command.output, [&] { write_mesh(command.output, body.mesh); });
    if (!command.truth.empty())
        write_result(command.truth,
                     synth::truth_to_json(body.truth, std::filesystem::path(command.output).filename().string()));
}

void add_shape_options(CLI::App& sub, SynthCommand& command) {
    synth::BodyShape& shape = command.shape;
    sub.add_option("--age", shape.age, "Years, 5 to 90")->capture_default_str();
    sub.add_option("--sex", command.sex, "female or male (the default)");
    sub.add_option("--masculinity", shape.masculinity, "Between woman (0) and man (1)")
        ->capture_default_str()
        ->excludes("--sex");
    sub.add_option("--height", shape.height, "Metres, 0.8 to 2.3; default: the average of age and sex");
    sub.add_option("--weight", shape.weight, "Kilograms, body mass index 12 to 60; default: the average");
    sub.add_option("--muscle", shape.muscle, "0 slack to 1 athletic")->capture_default_str();
    sub.add_option("--arm-length", shape.arm_length, "Factor, 0.4 to 1.8")->capture_default_str();
    sub.add_option("--leg-length", shape.leg_length, "Factor, 0.3 to 1.5; the height stays")->capture_default_str();
    sub.add_option("--torso-length", shape.torso_length, "Factor, 0.5 to 1.5; the height stays")->capture_default_str();
    sub.add_option("--head-size", shape.head_size, "Factor, 0.6 to 3.5; the height stays")->capture_default_str();
    sub.add_option("--hand-size", shape.hand_size, "Factor, 0.6 to 2.5")->capture_default_str();
    sub.add_option("--foot-size", shape.foot_size, "Factor, 0.6 to 2; the body's height stays")->capture_default_str();
    sub.add_option("--limb-girth", shape.limb_girth, "Factor on the thickness of arms and legs, 0.6 to 2")
        ->capture_default_str();
    sub.add_option("--shoulder-width", shape.shoulder_width, "Factor, 0.6 to 1.6")->capture_default_str();
    sub.add_option("--hip-width", shape.hip_width, "Factor, 0.6 to 1.6")->capture_default_str();
    sub.add_option("--mouth", shape.mouth, "0 closed to 1 open, with a cavity as far as the throat")
        ->capture_default_str();
}

} // namespace

void add_synth_command(CLI::App& app) {
    auto command = std::make_shared<SynthCommand>();
    CLI::App* sub = app.add_subcommand("synth", "Make a posed human body of which every joint is known");
    sub->add_option("-o,--output", command->output,
                    "Mesh to write: " + io::written_mesh_extensions_text() + "; a folder for --set")
        ->required();
    std::string sets = std::string("Make a whole set of meshes with their truth into a folder: ") + object_set + " " +
                       tube_set + " " + quadruped_set;
    for (const std::string& name : synth::set_names()) sets += " " + name;
    sub->add_option("--set", command->set, sets);
    sub->add_option("--truth", command->truth, "JSON to write with joints, end points and the geodesic diameter");
    std::string poses = "Pose: random, a JSON file, or";
    for (const std::string& name : synth::pose_names()) poses += " " + name;
    sub->add_option("--pose", command->pose, poses)->capture_default_str();
    sub->add_option("--seed", command->seed, "Of random poses, faults and characters")->capture_default_str();
    sub->add_option("--faces", command->faces, "Number of triangles, 5000 to 3000000, kept within 2 %")
        ->capture_default_str();
    std::string clothes = "What the body wears, one or more of";
    for (const std::string& name : synth::garment_names()) clothes += " " + name;
    sub->add_option("--wear", command->clothes, clothes);
    add_shape_options(*sub, *command);
    sub->footer("Examples:\n  skelgen synth -o body.off --truth body.json --pose walk\n"
                "  skelgen synth -o child.ply --age 7 --sex female --pose random --seed 3 --faces 50000\n"
                "  skelgen synth -o rider.off --pose t --wear trousers boots hat\n"
                "  skelgen synth --set faust -o bodies");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
