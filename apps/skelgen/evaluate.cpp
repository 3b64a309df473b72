#include <filesystem>
#include <memory>
#include <optional>

#include <skelgen/evaluation/evaluate.hpp>
#include <skelgen/evaluation/report.hpp>

#include "commands.hpp"
#include "console.hpp"

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

struct EvaluateCommand {
    std::string truth;
    std::string prediction;
    std::string meshes;
    std::string csv;
    std::string json;
    bool per_mesh = false;
};

/// Whether it is the truth file of something of which there should be no skeleton file.
bool is_of_no_body(const fs::path& truth) {
    return fs::is_regular_file(truth) && in_file(truth, [&] { return io::read_ground_truth(truth).not_a_body; });
}

std::vector<evaluation::SetScore> evaluate(const EvaluateCommand& command) {
    std::optional<fs::path> meshes;
    if (!command.meshes.empty()) meshes = command.meshes;
    if (!fs::exists(command.truth))
        throw Error(ErrorCode::bad_input, command.truth + ": no such file or folder; check the name");
    if (!fs::exists(command.prediction) && !is_of_no_body(command.truth))
        throw Error(ErrorCode::bad_input, command.prediction + ": no such file or folder; check the name");
    if (fs::exists(command.prediction) && fs::is_directory(command.truth) != fs::is_directory(command.prediction))
        throw Error(ErrorCode::usage, command.prediction + ": TRUTH and PREDICTION are not both files or both folders");
    if (fs::is_directory(command.truth)) return evaluate_folders(command.truth, command.prediction, meshes);
    const evaluation::MeshScore score = evaluate_file(command.truth, command.prediction, meshes);
    return {evaluation::SetScore{score.name, {score}}};
}

std::string report(const EvaluateCommand& command, const std::vector<evaluation::SetScore>& sets) {
    std::string text;
    for (const evaluation::SetScore& set : sets) {
        if (command.per_mesh)
            for (const evaluation::MeshScore& mesh : set.meshes)
                text += evaluation::mesh_score_line(set.name, mesh) + "\n";
        text += evaluation::summary_to_text(evaluation::summarise(set));
    }
    return text;
}

std::string csv(const std::vector<evaluation::SetScore>& sets) {
    std::vector<evaluation::SetSummary> summaries;
    for (const evaluation::SetScore& set : sets) summaries.push_back(evaluation::summarise(set));
    return evaluation::summaries_to_csv(summaries);
}

void run(const EvaluateCommand& command) {
    if (command.csv == "-" && command.json == "-")
        throw Error(ErrorCode::usage, "--csv and --json: both go to standard output; name a file for one");
    const std::vector<evaluation::SetScore> sets = evaluate(command);
    if (!command.csv.empty()) write_result(command.csv, csv(sets));
    if (!command.json.empty()) write_result(command.json, evaluation::scores_to_json(sets, command.per_mesh));
    if (command.csv != "-" && command.json != "-") write_result("-", report(command, sets));
}

} // namespace

void add_evaluate_command(CLI::App& app) {
    auto command = std::make_shared<EvaluateCommand>();
    CLI::App* sub = app.add_subcommand("evaluate", "Compare skeletons with the truth, joint by joint");
    sub->add_option("TRUTH", command->truth, "Truth file, or folder of <set>/<name>.json")->required();
    sub->add_option("PREDICTION", command->prediction, "Skeleton file, or folder of the same layout")->required();
    sub->add_option("--meshes", command->meshes, "The mesh, or folder of meshes: also tell the share of joints inside");
    // An option without a file's name means standard output.
    sub->add_option("--csv", command->csv, "Write the table as CSV, to FILE or standard output")
        ->type_name("FILE")
        ->expected(0, 1)
        ->default_str("-");
    sub->add_option("--json", command->json, "Write all figures as JSON, to FILE or standard output")
        ->type_name("FILE")
        ->expected(0, 1)
        ->default_str("-");
    sub->add_flag("--per-mesh", command->per_mesh, "Also a line on each mesh");
    sub->footer("Examples:\n"
                "  skelgen evaluate truth.json body.json\n"
                "  skelgen evaluate truth/ results/ --meshes meshes/ --per-mesh --csv table.csv");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
