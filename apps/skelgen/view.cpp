#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/applications/bone_sections.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/part_looks.hpp>
#include <skelgen/io/view_page.hpp>

#include "character.hpp"
#include "clip_input.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "fitted_file.hpp"
#include "fitted_inputs.hpp"
#include "mesh_input.hpp"
#include "progress_bar.hpp"
#include "view_bundle.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

struct ViewCommand {
    FittedInputs inputs;
    std::string output = "-";
    std::string clip; ///< empty: none
    DigitOptions digits;
};

/// What is shown of a mesh, and what there is to say of it.
struct Viewed {
    io::ViewedBody body;
    std::vector<std::string> repairs;
};

Viewed viewed(const BatchItem& item, const MeshInput& input, const DigitOptions& digits) {
    ExtractOptions options;
    options.prepare.component = item.component;
    FittedFile file = fit_file(input, options, true);
    if (item.component > 0) file = with_own_part(std::move(file));
    Extraction<double>& found = file.found;
    const SkeletonTemplate& skeleton_template = builtin_template(found.skeleton.template_name);
    io::ViewedBody body;
    body.name = item.file;
    body.source = std::move(file.source);
    body.sections = applications::bone_sections(found.body, found.skeleton, skeleton_template);
    body.rig = rig_of(found.mesh, found, skeleton_template, {}, digits.wanted(), digits.toes);
    KeptLooks kept = keep_looks(input);
    body.looks = io::looks_of(kept.looks, file.part);
    if (!kept.warning.empty()) found.skeleton.quality.warnings.push_back(std::move(kept.warning));
    body.skeleton = std::move(found.skeleton);
    body.curve = std::move(found.curve);
    return {std::move(body), std::move(found.body.repairs)};
}

/// The motion that a body follows: the given one, or the one that its own file has. What is no clip is none.
std::vector<applications::Animation<double>> motions(const std::optional<ClipInput>& clip, const BatchItem& item,
                                                     const applications::Rig<double>& rig) {
    if (clip) return {follow_clip(*clip, rig)};
    const auto format = io::mesh_format_of(item.mesh);
    if (!format || *format < io::MeshFormat::glb) return {}; // the others know no motion
    try {
        return {follow_clip(load_clip(item.mesh), rig)};
    } catch (const Error&) { // it was not asked for
        return {};
    }
}

/// A mesh as the page shows it, with or without a skeleton. \throws Error when it cannot be read, or a clip not be
/// followed.
std::string shown(const ViewCommand& command, const std::optional<ClipInput>& clip, const BatchItem& item) {
    if (!item.fault.empty()) throw Error(ErrorCode::bad_input, item.fault);
    MeshInput input{item.mesh};
    input.skeleton = command.inputs.skeleton;
    input.wanted = command.inputs.wanted;
    Viewed found;
    try {
        const WaitingLine waiting(item.mesh.string(), !command.inputs.quiet);
        found = viewed(item, input, command.digits);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_skeleton && error.code() != ErrorCode::bad_input) throw;
        const TriangleMesh<double> mesh = load_mesh(input); // what cannot be read is no mesh without a skeleton
        const std::string failure = std::string("no skeleton: ") + error.what();
        print_warning(item.mesh.string() + ": " + failure);
        return io::refused_body_to_json(item.file, failure, mesh);
    }
    found.body.animations = motions(clip, item, found.body.rig);
    print_warnings(item.mesh, found.body.skeleton, found.repairs, words_of(command.inputs.quiet));
    return viewed_body_to_json(found.body);
}

void run(const ViewCommand& command) {
    if (!command.clip.empty()) require_different_files(command.clip, command.output);
    const std::vector<BatchItem> items = find_items(command.inputs, {});
    for (const BatchItem& item : items) require_different_files(item.mesh, command.output);
    require_folder_of(command.output);
    if (!command.inputs.skeleton.empty() && are_many(command.inputs, items))
        throw Error(ErrorCode::usage, "--skeleton: is of one mesh, and there are several; give one alone");
    std::optional<ClipInput> clip;
    if (!command.clip.empty()) clip = load_clip(command.clip);
    std::vector<std::string> bodies;
    std::size_t failed = 0;
    ProgressBar bar(items.size(), !command.inputs.quiet && items.size() > 1, patience_seconds);
    for (const BatchItem& item : items) {
        try {
            bodies.push_back(in_file(item.mesh, [&] { return shown(command, clip, item); }));
        } catch (const Error& error) {
            if (!are_many(command.inputs, items)) throw;
            print_error(error.what());
            const std::string prefix = item.mesh.string() + ": ", what = error.what(); // the page names it already
            bodies.push_back(io::refused_body_to_json(
                item.file, what.rfind(prefix, 0) == 0 ? what.substr(prefix.size()) : what, {}));
            ++failed;
        }
        bar.show(bodies.size(), failed);
    }
    bar.clear();
    write_result(command.output, io::view_page(view_bundle(), bodies));
    if (failed > 0) throw CLI::RuntimeError(status_some_failed);
}

} // namespace

void add_view_command(CLI::App& app) {
    auto command = std::make_shared<ViewCommand>();
    CLI::App* sub = app.add_subcommand("view", "Bodies with all that is found in them, as a page for any browser");
    add_fitted_inputs(*sub, command->inputs);
    sub->add_option("-o,--output", command->output, "Page to write (.html), whole in itself; - for standard output")
        ->capture_default_str();
    sub->add_option("--clip,--bvh", command->clip,
                    "Motion for the bodies to follow in the page, as in `animate` (default: that of their own files)");
    add_digit_options(*sub, command->digits);
    sub->footer(
        "The page shows bodies side by side: materials, skeleton, weights; joints can be bent, and moved to where\n"
        "they belong: the page saves them as a skeleton, which `rig --skeleton` takes.\n"
        "What has no skeleton is there, too, and says why.\n\n"
        "Examples:\n  skelgen view body.off -o body.html\n  skelgen view scans/ --bvh walk.bvh -o scans.html");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
