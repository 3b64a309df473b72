#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <skelgen/evaluation/evaluate.hpp>
#include <skelgen/evaluation/reliability.hpp>
#include <skelgen/evaluation/report.hpp>
#if SKELGEN_WITH_RENDER
#include <skelgen/render/bar_chart.hpp>
#include <skelgen/render/png.hpp>
#endif

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
    std::string reliability;
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

#if SKELGEN_WITH_RENDER
/// Confidences beside how often joints that have them are near the truth.
std::string reliability_picture(const std::vector<evaluation::ReliabilityBin>& bins) {
    render::BarChart chart;
    std::size_t joints = 0;
    for (const evaluation::ReliabilityBin& bin : bins) {
        joints += bin.joints;
        if (bin.joints == 0) continue;
        chart.bars.push_back({bin.from, bin.to, static_cast<double>(bin.near) / static_cast<double>(bin.joints),
                              std::to_string(bin.joints)});
    }
    chart.title = std::to_string(joints) + " joints by their confidence";
    chart.across = "confidence";
    chart.upwards = "share within 0.03 of the truth";
    chart.diagonal = true;
    constexpr int width = 720, height = 540;
    return render::encode_png(render::draw_bar_chart(chart, width, height));
}
#endif

std::string reliability(const EvaluateCommand& command, const std::vector<evaluation::SetScore>& sets) {
    const std::vector<evaluation::ReliabilityBin> bins = evaluation::reliability(sets);
    if (!command.reliability.ends_with(".png")) return evaluation::reliability_to_json(bins);
#if SKELGEN_WITH_RENDER
    return reliability_picture(bins);
#else
    throw Error(ErrorCode::usage, "--reliability " + command.reliability +
                                      ": this program was built without pictures; name a .json file");
#endif
}

/// Does one of the results go to standard output, in the report's place?
bool replaces_report(const EvaluateCommand& command) {
    const std::array<std::pair<const char*, const std::string*>, 3> results{
        {{"--csv", &command.csv}, {"--json", &command.json}, {"--reliability", &command.reliability}}};
    const char* on_output = nullptr;
    for (const auto& [option, file] : results) {
        if (*file != "-") continue;
        if (on_output)
            throw Error(ErrorCode::usage, std::string(on_output) + " and " + option +
                                              ": both go to standard output; name a file for one");
        on_output = option;
    }
    return on_output != nullptr;
}

void run(const EvaluateCommand& command) {
    const bool has_report = !replaces_report(command);
    require_different_outputs(command.csv, "--csv", command.json, "--json");
    require_different_outputs(command.csv, "--csv", command.reliability, "--reliability");
    require_different_outputs(command.json, "--json", command.reliability, "--reliability");
    const std::vector<evaluation::SetScore> sets = evaluate(command);
    if (!command.csv.empty()) write_result(command.csv, csv(sets));
    if (!command.reliability.empty()) write_result(command.reliability, reliability(command, sets));
    if (!command.json.empty()) write_result(command.json, evaluation::scores_to_json(sets, command.per_mesh));
    if (has_report) write_result("-", report(command, sets));
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
    sub->add_option(
           "--reliability", command->reliability,
           "Write how often joints are within 0.03 of the truth by their confidence: a picture to FILE.png, JSON "
           "to any other FILE")
        ->type_name("FILE");
    sub->add_flag("--per-mesh", command->per_mesh, "Also a line on each mesh");
    sub->footer("Examples:\n"
                "  skelgen evaluate truth.json body.json\n"
                "  skelgen evaluate truth/ results/ --meshes meshes/ --per-mesh --csv table.csv");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
