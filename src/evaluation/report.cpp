#include <skelgen/evaluation/report.hpp>

#include <algorithm>
#include <array>
#include <cstdio>

#include <nlohmann/json.hpp>

#include <skelgen/evaluation/statistics.hpp>
#include <skelgen/hands/digit.hpp>

#include "io/number_text.hpp"

namespace skelgen::evaluation {
namespace {

using Json = nlohmann::ordered_json;

std::string four_digits(double value) {
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%.4f", value);
    return {text.data(), static_cast<std::size_t>(length)};
}

std::string shortest(double value) {
    std::string text;
    io::detail::append_number(text, value);
    return text;
}

std::string padded(const std::string& text, std::size_t width) {
    return text.size() < width ? text + std::string(width - text.size(), ' ') : text;
}

std::string list(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

std::string table_row(const std::string& joint, const ErrorStatistics& errors) {
    return "  " + padded(joint, 16) + four_digits(errors.mean) + "  " + four_digits(errors.median) + "  " +
           four_digits(errors.p95) + "  " + four_digits(errors.worst) + "  " + errors.worst_mesh + "\n";
}

using NamedStatistics = std::vector<std::pair<std::string, ErrorStatistics>>;

/// Joints in template order, which reads better than the alphabet, digits in theirs; then those that no template has.
NamedStatistics in_template_order(NamedStatistics joints) {
    std::vector<std::string> names = evaluated_joints();
    const std::vector<std::string>& of_animals = evaluated_joints(BodyKind::quadruped);
    names.insert(names.end(), of_animals.begin(), of_animals.end());
    for (const Side side : {Side::left, Side::right})
        for (const hands::DigitKind kind : {hands::DigitKind::finger, hands::DigitKind::toe})
            for (const hands::Digit digit : hands::all_digits)
                for (std::size_t number = 1; number <= hands::joints_of(kind); ++number)
                    names.push_back(hands::joint_name(side, digit, number, kind));
    std::stable_sort(joints.begin(), joints.end(), [&](const auto& a, const auto& b) {
        return std::find(names.begin(), names.end(), a.first) < std::find(names.begin(), names.end(), b.first);
    });
    return joints;
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string csv_row(const std::string& set, const std::string& joint, const ErrorStatistics& errors) {
    return csv_field(set) + "," + csv_field(joint) + "," + std::to_string(errors.count) + "," + shortest(errors.mean) +
           "," + shortest(errors.median) + "," + shortest(errors.p95) + "," + shortest(errors.worst) + "," +
           csv_field(errors.worst_mesh) + "\n";
}

Json to_json(const ErrorStatistics& errors) {
    return {{"meshes", errors.count}, {"mean", errors.mean},   {"median", errors.median},
            {"p95", errors.p95},      {"worst", errors.worst}, {"worst_mesh", errors.worst_mesh}};
}

Json to_json(const MeshScore& score) {
    Json json{{"solved", score.solved()}, {"complete", score.complete},       {"limbs", score.limbs},
              {"sides", score.sides},     {"wrong_limbs", score.wrong_limbs}, {"flipped", score.flipped}};
    if (score.not_a_body) json["refused"] = score.refused;
    json["outside"] = score.outside ? Json(*score.outside) : Json(nullptr);
    json["errors"] = Json::object();
    for (const auto& [joint, error] : score.errors) json["errors"][joint] = error;
    for (const auto& [joint, error] : score.digits) json["digits"][joint] = error;
    return json;
}

Json to_json(const SetSummary& summary) {
    Json json{{"meshes", summary.meshes},
              {"complete", summary.complete},
              {"limbs", summary.limbs},
              {"sides", summary.sides},
              {"solved", summary.solved}};
    if (summary.not_bodies > 0) {
        json["not_bodies"] = summary.not_bodies;
        json["refused"] = summary.refused;
    }
    const auto& errors = summary.errors;
    json["mean_error"] = errors ? Json(errors->mean) : Json(nullptr);
    json["median_error"] = errors ? Json(errors->median) : Json(nullptr);
    json["p95_error"] = errors ? Json(errors->p95) : Json(nullptr);
    json["worst_error"] = errors ? Json(errors->worst) : Json(nullptr);
    json["inside"] = summary.inside ? Json(*summary.inside) : Json(nullptr);
    json["per_joint"] = json["joints"] = Json::object();
    for (const auto& [joint, statistics] : summary.per_joint) {
        json["per_joint"][joint] = statistics.mean;
        json["joints"][joint] = to_json(statistics);
    }
    for (const auto& [joint, statistics] : summary.per_digit) json["digits"][joint] = to_json(statistics);
    if (summary.digits) json["all_digits"] = to_json(*summary.digits);
    return json;
}

} // namespace

std::string mesh_score_line(const std::string& set, const MeshScore& score) {
    std::string line = set + "/" + score.name + ": " + (score.solved() ? "solved" : "FAILED");
    if (score.not_a_body)
        line += score.refused ? ", no body and no skeleton" : ", a skeleton of what is no body";
    else if (!score.complete)
        line += ", no complete skeleton";
    if (!score.errors.empty()) {
        std::vector<double> errors;
        for (const auto& [joint, error] : score.errors) errors.push_back(error);
        line += ", mean error " + four_digits(mean(errors));
    }
    if (!score.wrong_limbs.empty()) line += ", wrong limbs " + list(score.wrong_limbs);
    if (!score.flipped.empty()) line += ", flipped " + list(score.flipped);
    if (score.outside && !score.outside->empty()) line += ", outside " + list(*score.outside);
    return line;
}

std::string summary_to_text(const SetSummary& summary) {
    std::string text = summary.name + ": solved " + std::to_string(summary.solved) + "/" +
                       std::to_string(summary.meshes) + " (complete " + std::to_string(summary.complete) +
                       ", limbs right " + std::to_string(summary.limbs) + ", sides right " +
                       std::to_string(summary.sides) + ")";
    if (summary.not_bodies > 0)
        text += ", no bodies " + std::to_string(summary.not_bodies) + ", without a skeleton as they should be " +
                std::to_string(summary.refused);
    if (summary.inside) text += ", joints inside " + four_digits(*summary.inside);
    text += "\n";
    if (!summary.errors) return text;
    text += "  error over solved meshes, in parts of the largest geodesic distance\n";
    text += "  joint           mean    median  95 %    worst   in\n";
    for (const auto& [joint, errors] : in_template_order(summary.per_joint)) text += table_row(joint, errors);
    text += table_row("all", *summary.errors);
    for (const auto& [joint, errors] : in_template_order(summary.per_digit)) text += table_row(joint, errors);
    return summary.digits ? text + table_row("all digits", *summary.digits) : text;
}

std::string summaries_to_csv(const std::vector<SetSummary>& summaries) {
    std::string text = "set,joint,count,mean,median,p95,worst,worst_mesh\n";
    for (const SetSummary& summary : summaries) {
        const auto add = [&](const NamedStatistics& joints, const char* all, const auto& of_all) {
            for (const auto& [joint, errors] : in_template_order(joints)) text += csv_row(summary.name, joint, errors);
            if (of_all) text += csv_row(summary.name, all, *of_all);
        };
        add(summary.per_joint, "all", summary.errors);
        add(summary.per_digit, "all digits", summary.digits);
    }
    return text;
}

std::string scores_to_json(const std::vector<SetScore>& sets, bool with_meshes) {
    Json json = Json::object();
    for (const SetScore& set : sets) {
        Json& entry = json[set.name] = to_json(summarise(set));
        if (!with_meshes) continue;
        entry["per_mesh"] = Json::object();
        for (const MeshScore& mesh : set.meshes) entry["per_mesh"][mesh.name] = to_json(mesh);
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace skelgen::evaluation
