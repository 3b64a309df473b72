#include "hands.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <skelgen/evaluation/statistics.hpp>
#include <skelgen/hands/digit.hpp>
#include <skelgen/io/read_file.hpp>

namespace skelgen::regression {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Chain = std::vector<std::string>; ///< names of digits that are one

/// The joints of digits by name, and the digits that are one with one of them by its first joint's.
struct NamedDigits {
    Json joints = Json::object(), fused = Json::object();
};

NamedDigits digits_of_truth(const Json& truth) {
    return {truth.value("fingers", Json::object()), truth.value("fused", Json::object())};
}

NamedDigits digits_of_skeleton(const fs::path& file) {
    NamedDigits out;
    if (!fs::exists(file)) return out;
    for (const Json& joint : Json::parse(io::read_file(file)).value("joints", Json::array())) {
        const std::string name = joint.at("name");
        if (joint.contains("position")) out.joints[name] = joint["position"];
        if (joint.contains("fused")) out.fused[name] = joint["fused"];
    }
    return out;
}

std::vector<Chain> chains(const NamedDigits& digits, Side side) {
    std::vector<Chain> out;
    for (const hands::Digit digit : hands::all_digits) {
        const std::string first = hands::joint_name(side, digit, 1);
        if (!digits.joints.contains(first)) continue;
        const std::string name(hands::name_of(digit));
        if (!out.empty() && std::find(out.back().begin(), out.back().end(), name) != out.back().end()) continue;
        out.push_back({name});
        if (digits.fused.contains(first))
            for (const Json& other : digits.fused[first]) out.back().push_back(other.get<std::string>());
    }
    return out;
}

Vector3<double> place(const NamedDigits& digits, Side side, const std::string& digit, std::size_t number) {
    const Json& p = digits.joints.at(std::string(side_prefix(side)) + digit + "_" + std::to_string(number));
    return {p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()};
}

} // namespace

HandScores measure_hands(const fs::path& folder) {
    HandScores scores;
    std::vector<double> errors;
    for (const auto& entry : fs::directory_iterator(folder / "truth" / hand_set)) {
        const Json truth = Json::parse(io::read_file(entry.path()));
        const NamedDigits known = digits_of_truth(truth),
                          found = digits_of_skeleton(folder / "skeletons" / hand_set / entry.path().filename());
        for (const Side side : {Side::left, Side::right}) {
            const std::vector<Chain> is = chains(found, side), should = chains(known, side);
            const Chain thumb{std::string(hands::name_of(hands::Digit::thumb))};
            const auto begins_with_thumb = [&](const auto& all) { return !all.empty() && all.front() == thumb; };
            ++scores.hands;
            scores.counted += is.size() == should.size() ? 1 : 0;
            scores.thumbs += begins_with_thumb(is) && begins_with_thumb(should) ? 1 : 0;
            const auto are_alike = [&] { // whether the thumb is in the one chain of a fist, nobody can tell
                return is == should || (is.size() == 1 && should.size() == 1 && is[0].back() == should[0].back());
            };
            scores.told += should.size() < hands::all_digits.size() && are_alike() ? 1 : 0;
            const bool has_fused =
                std::any_of(should.begin(), should.end(), [](const Chain& chain) { return chain.size() > 1; });
            if (is.size() != should.size() || has_fused) continue;
            for (std::size_t i = 0; i < is.size(); ++i)
                for (std::size_t k = 1; k <= hands::phalanges; ++k)
                    errors.push_back(
                        (place(found, side, is[i].front(), k) - place(known, side, should[i].front(), k)).norm() /
                        truth.at("scale").get<double>());
        }
    }
    if (!errors.empty()) scores.error = evaluation::percentile(errors, 50);
    return scores;
}

} // namespace skelgen::regression
