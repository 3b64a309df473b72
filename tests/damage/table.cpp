#include "table.hpp"

#include <iomanip>
#include <map>
#include <regex>
#include <sstream>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/evaluation/evaluate.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/read_file.hpp>

#include "kinds.hpp"

namespace skelgen::damage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double sure = 0.8;

/// Does `work`; an error of the input says which file it is about.
template <typename Work>
auto naming(const fs::path& file, const Work& work) {
    try {
        return work(file);
    } catch (const Error& error) {
        throw Error(error.code(), file.string() + ": " + error.what());
    }
}

/// A line of a batch's summary.
struct Line {
    std::string status, error;
    double seconds = 0;
};

std::map<std::string, Line> read_summary(const fs::path& file) {
    std::map<std::string, Line> lines;
    std::istringstream text(naming(file, io::read_file));
    for (std::string line; std::getline(text, line);) try {
            const Json json = Json::parse(line);
            lines[json.at("file").get<std::string>()] = {json.at("status").get<std::string>(),
                                                         json.at("error").is_null() ? "" : json.at("error"),
                                                         json.at("seconds").get<double>()};
        } catch (const Json::exception& error) {
            throw Error(ErrorCode::bad_input, file.string() + ": is no summary: " + error.what());
        }
    return lines;
}

double confidence(const fs::path& skeleton) {
    return Json::parse(io::read_file(skeleton)).at("quality").at("sides_confidence").get<double>();
}

bool says_two(const std::string& text) {
    return std::regex_search(text, std::regex("\\b(2|two)( [a-z]+)? (bodies|people)\\b"));
}

/// The sum over solved meshes, until all are in.
struct Sum {
    Row row;
    double errors = 0;
    std::size_t joints = 0;
};

void add_body(Sum& sum, const std::string& name, const io::GroundTruth& truth, const fs::path& skeleton,
              const Line& line) {
    const auto found = evaluation::read_joint_positions(skeleton);
    const auto score = evaluation::score_joints(truth, found);
    if (score.solved()) {
        ++sum.row.solved;
        for (const auto& [joint, error] : score.errors) sum.errors += error, ++sum.joints;
        return;
    }
    const bool is_sure = !found.empty() && confidence(skeleton) > sure;
    sum.row.wrong_sure += is_sure ? 1 : 0;
    std::string why = line.status == "ok" ? (is_sure ? "wrong and sure" : "wrong") : line.error;
    for (const std::string& limb : score.wrong_limbs) why += " " + limb;
    for (const std::string& joint : score.flipped) why += " " + joint;
    sum.row.failed.push_back(name + ": " + why);
}

void add_bodies(Sum& sum, const std::string& name, const fs::path& skeleton, const Line& line) {
    if (line.status == "no_skeleton" && says_two(line.error)) {
        ++sum.row.solved;
        return;
    }
    const bool is_sure = line.status == "ok" && confidence(skeleton) > sure;
    sum.row.wrong_sure += is_sure ? 1 : 0;
    sum.row.failed.push_back(name + ": " + (line.status == "ok" ? "one skeleton" : line.error));
}

void add_no_surface(Sum& sum, const std::string& name, const fs::path& skeleton, const Line& line) {
    if (line.status == "bad_input") {
        ++sum.row.solved;
        return;
    }
    const bool is_sure = line.status == "ok" && confidence(skeleton) > sure;
    sum.row.wrong_sure += is_sure ? 1 : 0;
    sum.row.failed.push_back(name + ": " + (line.status == "ok" ? "a skeleton" : line.error));
}

Row finished(Sum sum) {
    if (sum.joints > 0) sum.row.mean_error = sum.errors / static_cast<double>(sum.joints);
    return std::move(sum.row);
}

Row score_kind(const Kind& kind, const fs::path& truth, const fs::path& skeletons, const std::string& prefix,
               const std::map<std::string, Line>& summary) {
    Sum sum;
    sum.row.kind = kind.name;
    for (const auto& [file, line] : summary) {
        if (file.rfind(prefix, 0) != 0) continue;
        const fs::path name = fs::path(file.substr(prefix.size())).replace_extension(".json");
        const fs::path skeleton = (skeletons / file).replace_extension(".json");
        ++sum.row.meshes;
        if (line.seconds >= sum.row.worst_seconds) sum.row.worst_seconds = line.seconds, sum.row.slowest = file;
        if (!kind.is_surface)
            add_no_surface(sum, file, skeleton, line);
        else if (kind.is_one_body)
            add_body(sum, file, truth_after(kind, naming(truth / name, io::read_ground_truth)), skeleton, line);
        else
            add_bodies(sum, file, skeleton, line);
    }
    return finished(std::move(sum));
}

} // namespace

std::vector<Row> score(const fs::path& truth, const fs::path& folder) {
    Kind clean;
    clean.name = "clean";
    std::vector<Row> rows{
        score_kind(clean, truth, folder / "clean", "", read_summary(folder / "clean" / "summary.jsonl"))};
    const std::map<std::string, Line> summary = read_summary(folder / "skeletons" / "summary.jsonl");
    for (const Kind& kind : kinds()) {
        Row row = score_kind(kind, truth, folder / "skeletons", kind.name + "/", summary);
        if (row.meshes > 0) rows.push_back(std::move(row));
    }
    return rows;
}

std::string to_table(const std::vector<Row>& rows) {
    std::ostringstream text;
    text << "damage         meshes  solved  mean error  of clean  wrong, sure  worst time  slowest\n" << std::fixed;
    for (const Row& row : rows) {
        const double clean = rows.front().mean_error;
        text << std::left << std::setw(13) << row.kind << std::right << std::setw(8) << row.meshes << std::setw(8)
             << row.solved << std::setprecision(4) << std::setw(12);
        if (row.mean_error > 0 && clean > 0)
            text << row.mean_error << std::setprecision(2) << std::setw(10) << row.mean_error / clean;
        else
            text << "-" << std::setw(10) << "-";
        text << std::setw(13) << row.wrong_sure << std::setprecision(2) << std::setw(10) << row.worst_seconds << " s  "
             << row.slowest << '\n';
    }
    return text.str();
}

} // namespace skelgen::damage
