#include "scores.hpp"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/evaluation/evaluate.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/hands/find_hands.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/read_file.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/skeleton_json.hpp>

#include "bodies.hpp"
#include "hands.hpp"
#include "parallel.hpp"
#include "tubes.hpp"

namespace skelgen::regression {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* tube_set = "tubes";
constexpr double near_enough = 0.1; ///< of a curve to its axis, in local radii

/// Four digits are what a skeleton's error is good for, and what a difference can be read in.
double rounded(double error) { return std::round(error * 1e4) / 1e4; }

std::vector<fs::path> meshes_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (io::mesh_format_of(entry.path())) files.push_back(entry.path());
    return files;
}

/// Animals are looked for as one of two: a person in their place is as wrong as nothing.
ExtractOptions options_for(const fs::path& mesh) {
    ExtractOptions options;
    options.or_quadruped = mesh.parent_path().filename() == quadruped_set;
    return options;
}

/// Writes the skeleton to the file if there is one. A fault on the way is no refusal: it leaves a file that scores as
/// no skeleton of a body, and as one of what is no body.
void extract(const fs::path& mesh, const fs::path& skeleton) {
    try {
        const TriangleMesh<double> input = read_mesh<double>(mesh);
        const Extraction<double> found = extract_skeleton(input, options_for(mesh));
        if (mesh.parent_path().filename() != hand_set) return write_skeleton(skeleton, found.skeleton);
        const auto hands = hands::find_hands(input, found.body, found.skeleton);
        io::SkeletonProvenance provenance;
        provenance.fused = hands::fused_digits(hands);
        io::write_file_atomically(skeleton,
                                  io::skeleton_to_json(hands::with_digits(found.skeleton, hands), provenance));
        return;
    } catch (const Error& error) {
        if (error.code() == ErrorCode::no_skeleton || error.code() == ErrorCode::bad_input) return;
        std::cerr << mesh.string() + ": " + error.what() + "\n";
    } catch (const std::exception& error) {
        std::cerr << mesh.string() + ": " + error.what() + "\n";
    }
    io::write_file_atomically(skeleton, "{}\n");
}

/// Extracts every mesh below the folder to the same place below another.
void extract_all(const fs::path& meshes, const fs::path& skeletons, unsigned jobs) {
    const std::vector<fs::path> files = meshes_below(meshes);
    test::for_each_index(files.size(), jobs, [&](std::size_t i) {
        const fs::path skeleton = (skeletons / files[i].lexically_relative(meshes)).replace_extension(".json");
        fs::create_directories(skeleton.parent_path());
        extract(files[i], skeleton);
    });
}

/// Of a set of bodies: how many are solved, how many have their sides right, and the mean errors. Of a set of what is
/// no body: how many were refused.
SetResult to_result(const evaluation::SetSummary& summary) {
    SetResult result;
    result.meshes = summary.meshes;
    if (summary.not_bodies > 0)
        result.counts = {{"refused", summary.refused}};
    else
        result.counts = {{"solved", summary.solved}, {"sides", summary.sides}};
    for (const auto& [joint, statistics] : summary.per_joint) result.joints[joint] = rounded(statistics.mean);
    return result;
}

/// Of the tubes: how many curves have as many ends and cycles as the axis, and how many are near it everywhere.
SetResult to_result(const std::vector<TubeScore>& scores) {
    SetResult result;
    result.meshes = scores.size();
    double sum = 0;
    std::size_t found = 0; // of the curves, those that have nodes
    for (const auto& [name, error] : scores) {
        result.counts["ends"] += error.ends == error.true_ends ? 1 : 0;
        result.counts["cycles"] += error.cycles == error.true_cycles ? 1 : 0;
        result.counts["near"] += error.hausdorff <= near_enough ? 1 : 0;
        if (!std::isfinite(error.mean)) continue;
        sum += error.mean;
        ++found;
    }
    if (found > 0) result.axis = rounded(sum / static_cast<double>(found));
    return result;
}

Json to_json(const SetResult& result) {
    Json json{{"meshes", result.meshes}};
    for (const auto& [name, count] : result.counts) json[name] = count;
    if (!result.joints.empty()) json["joints"] = result.joints;
    if (result.axis) json["axis"] = *result.axis;
    if (result.digits) json["digit_joints"] = *result.digits;
    return json;
}

SetResult to_result(const Json& json) {
    SetResult result;
    for (const auto& [key, value] : json.items()) {
        if (key == "meshes")
            result.meshes = value.get<std::size_t>();
        else if (key == "joints")
            result.joints = value.get<std::map<std::string, double>>();
        else if (key == "axis")
            result.axis = value.get<double>();
        else if (key == "digit_joints")
            result.digits = value.get<double>();
        else
            result.counts[key] = value.get<std::size_t>();
    }
    return result;
}

std::string line(const std::string& set, const std::string& what, const std::string& before, const std::string& after) {
    std::ostringstream text;
    text << std::left << std::setw(12) << set << ' ' << std::setw(15) << what << ' ' << std::right << std::setw(7)
         << before << " -> " << std::setw(7) << after;
    return text.str();
}

std::string digits(double error) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(4) << error;
    return text.str();
}

/// The two maps' values for every key of either, as text; "-" where there is none.
template <typename Value, typename ToText, typename Visit>
void for_each_pair(const std::map<std::string, Value>& a, const std::map<std::string, Value>& b, const ToText& to_text,
                   const Visit& visit) {
    std::map<std::string, std::pair<std::string, std::string>> pairs;
    for (const auto& [key, value] : a) pairs[key] = {to_text(value), "-"};
    for (const auto& [key, value] : b) {
        auto& pair = pairs[key];
        if (pair.first.empty()) pair.first = "-";
        pair.second = to_text(value);
    }
    for (const auto& [key, pair] : pairs) visit(key, pair.first, pair.second);
}

double mean_error(const SetResult& result) {
    double sum = 0;
    for (const auto& [joint, error] : result.joints) sum += error;
    return sum / static_cast<double>(result.joints.size());
}

std::size_t count_or_none(const SetResult& result, const std::string& name) {
    const auto found = result.counts.find(name);
    return found == result.counts.end() ? 0 : found->second;
}

std::string digits_or_none(const std::optional<double>& error) { return error ? digits(*error) : "-"; }

} // namespace

Results measure(const fs::path& folder, unsigned jobs) {
    const fs::path skeletons = folder / "skeletons";
    fs::remove_all(skeletons);
    extract_all(folder / "meshes", skeletons, jobs);
    Results results;
    for (const evaluation::SetScore& score : evaluate_folders(folder / "truth", skeletons)) {
        const evaluation::SetSummary summary = summarise(score);
        results[summary.name] = to_result(summary);
    }
    const HandScores hands = measure_hands(folder);
    SetResult& of_hands = results[hand_set];
    of_hands.counts["counted"] = hands.counted;
    of_hands.counts["thumbs"] = hands.thumbs;
    of_hands.counts["told"] = hands.told;
    if (hands.error) of_hands.digits = rounded(*hands.error);
    const std::vector<TubeScore> tubes = measure_tubes(folder / tube_set, jobs);
    io::write_file_atomically(folder / tube_set / "scores.txt", to_table(tubes));
    results[tube_set] = to_result(tubes);
    return results;
}

Expectations read_expectations(const fs::path& file) {
    try {
        const Json json = Json::parse(io::read_file(file));
        Expectations expectations;
        const Json& tolerances = json.at("tolerances");
        expectations.tolerances.count = tolerances.at("count").get<std::size_t>();
        expectations.tolerances.joint_error = tolerances.at("joint_error").get<double>();
        expectations.tolerances.axis_error = tolerances.value("axis_error", expectations.tolerances.axis_error);
        expectations.tolerances.digit_error = tolerances.value("digit_error", expectations.tolerances.digit_error);
        for (const auto& [set, result] : json.at("sets").items()) expectations.sets[set] = to_result(result);
        return expectations;
    } catch (const Json::exception& error) {
        throw Error(ErrorCode::bad_input, file.string() + ": holds no expected scores: " + error.what());
    }
}

void write_expectations(const fs::path& file, const Expectations& expectations) {
    Json sets = Json::object();
    for (const auto& [set, result] : expectations.sets) sets[set] = to_json(result);
    const Json json{{"tolerances",
                     {{"count", expectations.tolerances.count},
                      {"joint_error", expectations.tolerances.joint_error},
                      {"axis_error", expectations.tolerances.axis_error},
                      {"digit_error", expectations.tolerances.digit_error}}},
                    {"sets", sets}};
    io::write_file_atomically(file, json.dump(1) + "\n");
}

std::vector<std::string> moves(const Results& before, const Results& after) {
    std::vector<std::string> lines;
    Results all = before;
    all.insert(after.begin(), after.end());
    for (const auto& [set, unused] : all) {
        const auto part = [name = set](const Results& results) {
            const auto found = results.find(name);
            return found == results.end() ? SetResult{} : found->second;
        };
        const SetResult a = part(before), b = part(after);
        const auto add = [&lines, name = set](const std::string& what, const std::string& was, const std::string& is) {
            if (was != is) lines.push_back(line(name, what, was, is));
        };
        add("meshes", std::to_string(a.meshes), std::to_string(b.meshes));
        for_each_pair(
            a.counts, b.counts, [](std::size_t count) { return std::to_string(count); }, add);
        for_each_pair(a.joints, b.joints, digits, add);
        add("axis", digits_or_none(a.axis), digits_or_none(b.axis));
        add("digit joints", digits_or_none(a.digits), digits_or_none(b.digits));
    }
    return lines;
}

std::vector<std::string> regressions(const Expectations& expected, const Results& found) {
    std::vector<std::string> lines;
    for (const auto& [set, result] : expected.sets) {
        const auto now = found.find(set);
        if (now == found.end() || now->second.meshes != result.meshes) {
            lines.push_back(set + ": is not made of the same meshes");
            continue;
        }
        for (const auto& [name, count] : result.counts)
            if (const std::size_t is = count_or_none(now->second, name); is + expected.tolerances.count < count)
                lines.push_back(line(set, name, std::to_string(count), std::to_string(is)));
        if (result.axis && !(now->second.axis && *now->second.axis <= *result.axis + expected.tolerances.axis_error))
            lines.push_back(line(set, "axis", digits_or_none(result.axis), digits_or_none(now->second.axis)));
        if (result.digits &&
            !(now->second.digits && *now->second.digits <= *result.digits + expected.tolerances.digit_error))
            lines.push_back(
                line(set, "digit joints", digits_or_none(result.digits), digits_or_none(now->second.digits)));
        // The errors are of the solved meshes: of others, they are not to be compared.
        if (count_or_none(now->second, "solved") != count_or_none(result, "solved")) continue;
        for (const auto& [joint, error] : result.joints) {
            const auto is = now->second.joints.find(joint);
            if (is == now->second.joints.end())
                lines.push_back(line(set, joint, digits(error), "-"));
            else if (is->second > error + expected.tolerances.joint_error)
                lines.push_back(line(set, joint, digits(error), digits(is->second)));
        }
    }
    return lines;
}

std::string to_table(const Results& results) {
    std::ostringstream text;
    text << "set          meshes  solved   sides refused    ends  cycles    near   mean error\n";
    for (const auto& [set, result] : results) {
        text << std::left << std::setw(12) << set << std::right << std::setw(7) << result.meshes;
        for (const char* count : {"solved", "sides", "refused", "ends", "cycles", "near"})
            text << std::setw(8)
                 << (result.counts.count(count) > 0 ? std::to_string(result.counts.at(count)) : std::string("-"));
        text << std::setw(13) << (result.joints.empty() ? digits_or_none(result.axis) : digits(mean_error(result)))
             << '\n';
    }
    return text.str();
}

} // namespace skelgen::regression
