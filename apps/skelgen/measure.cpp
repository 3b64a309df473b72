#include <memory>

#include <skelgen/applications/measurement.hpp>
#include <skelgen/applications/segmentation.hpp>
#include <skelgen/io/measurements_text.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "fitted_inputs.hpp"

namespace skelgen::cli {
namespace {

struct MeasureCommand {
    FittedInputs inputs;
    std::string output = "-";
    bool as_csv = false;
};

io::MeasuredBody measured(const FittedInput& input) {
    const KinematicSkeleton<double>& skeleton = input.skeleton();
    const applications::Segmentation parts = applications::segment(input.found.body, skeleton);
    io::SourceMesh source = input.source;
    source.file = input.item.file;
    return {source, skeleton.quality, applications::measure(input.found.body, skeleton, parts)};
}

void run(const MeasureCommand& command) {
    const std::vector<BatchItem> items = find_items(command.inputs, {});
    for (const BatchItem& item : items) require_different_files(item.mesh, command.output);
    require_folder_of(command.output);
    std::vector<io::MeasuredBody> bodies;
    const auto write = [&] {
        const bool is_csv = command.as_csv || std::filesystem::path(command.output).extension() == ".csv";
        write_result(command.output, is_csv ? io::measurements_to_csv(bodies) : io::measurements_to_json(bodies));
    };
    try {
        for_each_fitted(command.inputs, items, [&](const FittedInput& input) { bodies.push_back(measured(input)); });
    } catch (const CLI::RuntimeError&) { // some have failed, as has been said: the others' measures are written
        write();
        throw;
    }
    write();
}

} // namespace

void add_measure_command(CLI::App& app) {
    auto command = std::make_shared<MeasureCommand>();
    CLI::App* sub = app.add_subcommand(
        "measure", "Measure bodies: height, arm span, bones, girths, area and volume, in the mesh's own unit");
    add_fitted_inputs(*sub, command->inputs);
    sub->add_option("-o,--output", command->output,
                    "File to write: .json, or .csv with a line for each body; - for JSON")
        ->capture_default_str();
    sub->add_flag("--csv", command->as_csv, "CSV whatever the file is called");
    sub->footer("Examples:\n  skelgen measure body.off\n  skelgen measure scans/ -o people.csv");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
