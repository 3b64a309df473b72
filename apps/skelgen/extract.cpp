#include <algorithm>
#include <cstdio>
#include <locale>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/trail_json.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "extract_file.hpp"
#include "fitted_file.hpp"
#include "nearest_word.hpp"
#include "trail_text.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

struct ExtractCommand {
    MeshInput mesh;
    std::string output = "-";
    std::string skeleton_template = "human21";
    std::string fingers = "off";
    bool toes = false;
    std::string curve;
    std::string trail;
    std::vector<std::string> hints; ///< "left_hand=x,y,z" each
    int component = 0;              ///< 0: the only one
    int threads = 1;
    bool verbose = false;
    bool quiet = false;
};

void print_details(const FileExtraction& result) {
    const auto& mesh = *result.provenance.mesh;
    const auto& timings = *result.provenance.timings_ms;
    const auto& quality = result.skeleton().quality;
    std::fprintf(stderr, "%s: %lld vertices, %lld faces, geodesic diameter %.6g\n", mesh.file.c_str(),
                 static_cast<long long>(mesh.vertices), static_cast<long long>(mesh.faces), mesh.geodesic_diameter);
    std::fprintf(stderr, "%s: %d template nodes matched, right with a probability of %.2f\n", mesh.file.c_str(),
                 quality.matched_nodes, quality.sides_confidence);
    std::fprintf(stderr,
                 "%s: read %.1f ms, surface %.1f, curve %.1f, embed %.1f, refine %.1f, sides %.1f, total %.1f\n",
                 mesh.file.c_str(), timings.read, timings.stages.surface, timings.stages.curve, timings.stages.embed,
                 timings.stages.refine, timings.stages.sides, timings.stages.total);
}

/// What a hint says. \throws Error usage when it is not as NAME=X,Y,Z.
Hint hint_of(const std::string& text) {
    Hint hint;
    std::string rest;
    char between = 0, other = 0;
    const std::size_t sign = text.find('=');
    std::istringstream place(sign == std::string::npos ? "" : text.substr(sign + 1));
    place.imbue(std::locale::classic());
    place >> hint.position[0] >> between >> hint.position[1] >> other >> hint.position[2];
    if (!place || between != ',' || other != ',' || place >> rest)
        throw Error(ErrorCode::usage, "--hint " + text + ": must be a joint and its place, as left_hand=0.5,1.2,0");
    hint.joint = text.substr(0, sign);
    return hint;
}

/// \throws Error usage when the template has no joint of a hint's name.
void require_joints(const std::vector<Hint>& hints, const SkeletonTemplate& skeleton_template) {
    std::vector<std::string> names;
    for (const TemplateJoint& joint : skeleton_template.joints) names.push_back(joint.name);
    for (const Hint& hint : hints) {
        if (std::find(names.begin(), names.end(), hint.joint) != names.end()) continue;
        const std::string meant = nearest_word(hint.joint, names);
        throw Error(ErrorCode::usage, "--hint " + hint.joint + ": there is no such joint" +
                                          (meant.empty() ? "" : "; did you mean " + meant + "?"));
    }
}

void write_trail(const ExtractCommand& command, const Trail& trail) {
    if (!command.trail.empty()) write_result(command.trail, io::trail_to_json(trail));
}

void run(const ExtractCommand& command) {
    require_different_files(command.mesh.file, command.output);
    require_different_files(command.mesh.file, command.curve);
    require_different_files(command.mesh.file, command.trail);
    for (const std::string& output : {command.output, command.curve, command.trail}) require_folder_of(output);
    require_different_outputs(command.output, "-o", command.curve, "--curve");
    require_different_outputs(command.output, "-o", command.trail, "--trail");
    require_different_outputs(command.curve, "--curve", command.trail, "--trail");
    std::vector<Hint> hints;
    for (const std::string& text : command.hints) hints.push_back(hint_of(text));
    ExtractOptions options;
    const auto named = template_and_fingers(command.skeleton_template, command.fingers, command.toes);
    want_template(options, named.first);
    if (!hints.empty() && options.or_quadruped)
        throw Error(ErrorCode::usage,
                    "--hint: name the template whose joints these are, human21 or quadruped, not auto");
    require_joints(hints, options.skeleton_template);
    options.prepare.component = command.component;
    options.threads = command.threads;
    options.with_curve = !command.curve.empty();
    const auto result = in_file(command.mesh.file, [&] {
        try {
            const WaitingLine waiting(command.mesh.file.string(), !command.quiet);
            return extract_file(command.mesh, options, named.second, hints, command.toes);
        } catch (const NoSkeleton& refused) {
            if (command.verbose) print_trail(command.mesh.file, refused.trail());
            write_trail(command, refused.trail());
            throw;
        }
    });

    if (!command.curve.empty()) in_file(command.curve, [&] { write_curve(command.curve, result.found.curve); });
    write_trail(command, result.found.trail);
    write_result(command.output, result.json);
    if (command.verbose) {
        print_trail(command.mesh.file, result.found.trail);
        print_details(result);
    }
    const Words words = command.verbose ? Words::all : words_of(command.quiet);
    print_warnings(command.mesh.file, result.skeleton(), result.found.body.repairs, words);
}

} // namespace

void add_extract_command(CLI::App& app) {
    auto command = std::make_shared<ExtractCommand>();
    CLI::App* sub = app.add_subcommand("extract", "Find the skeleton in the mesh of a body");
    add_mesh_input(*sub, command->mesh, "Mesh of one body");
    sub->add_option("-o,--output", command->output, "Skeleton file to write (JSON); - for standard output");
    sub->add_option(
           "--template", command->skeleton_template,
           "Built-in template (human21, pinocchio18, quadruped), auto for a person or a four-legged animal, or a "
           "template's file (JSON); human51: human21 with fingers")
        ->capture_default_str();
    sub->add_option("--fingers", command->fingers, "Joints of the fingers: none, all, or where the surface shows some")
        ->check(CLI::IsMember({"auto", "off", "on"}))
        ->capture_default_str();
    sub->add_flag("--toes", command->toes, "Also joints of the single toes, where the surface shows them");
    sub->add_option("--curve", command->curve, "Also write the curve skeleton: .json, .obj, .ply or .swc");
    sub->add_option("--trail", command->trail, "Also write what was tried and what came of it (JSON), found or not");
    sub->add_option(
           "--hint", command->hints,
           "Where a joint is, in the mesh's coordinates: left_hand=x,y,z; any number. The skeleton that is most\n"
           "likely and nearest to all hints is bent to them, however unlikely it is")
        ->take_all();
    add_component_option(*sub, command->component);
    sub->add_option("--threads", command->threads,
                    "Threads that work on it; the result does not depend on their number")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    CLI::Option* verbose = sub->add_flag("-v,--verbose", command->verbose,
                                         "Tell sizes, confidence, timings, and what was tried and what came of it");
    sub->add_flag("-q,--quiet", command->quiet, "No warnings but that the skeleton is a guess")->excludes(verbose);
    sub->footer("Examples:\n  skelgen extract body.off -o body.json\n"
                "  skelgen extract dragon.glb --hint left_hand=0.7,1.1,0.2 --hint head=0,1.6,0.1 -o dragon.json");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
