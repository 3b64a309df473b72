#include <skelgen/evaluation/reliability.hpp>

#include <algorithm>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>

namespace skelgen::evaluation {

std::vector<ReliabilityBin> reliability(const std::vector<SetScore>& sets, std::size_t bins, double near) {
    if (bins == 0) throw Error(ErrorCode::usage, "reliability needs one bin or more");
    const double width = 1 / static_cast<double>(bins);
    std::vector<ReliabilityBin> out(bins);
    for (std::size_t b = 0; b < bins; ++b) out[b].from = width * double(b), out[b].to = width * double(b + 1);
    for (const SetScore& set : sets)
        for (const MeshScore& mesh : set.meshes)
            for (const auto& [joint, error] : mesh.errors) {
                const auto confidence = mesh.confidences.find(joint);
                if (confidence == mesh.confidences.end()) continue;
                const double place = std::clamp(confidence->second, 0.0, 1.0) * static_cast<double>(bins);
                ReliabilityBin& bin = out[std::min(static_cast<std::size_t>(place), bins - 1)];
                ++bin.joints;
                bin.near += error <= near ? 1 : 0;
                bin.mean_confidence += confidence->second;
            }
    for (ReliabilityBin& bin : out)
        if (bin.joints > 0) bin.mean_confidence /= static_cast<double>(bin.joints);
    return out;
}

std::string reliability_to_json(const std::vector<ReliabilityBin>& bins) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const ReliabilityBin& bin : bins)
        json.push_back({{"from", bin.from},
                        {"to", bin.to},
                        {"joints", bin.joints},
                        {"near", bin.near},
                        {"mean_confidence", bin.mean_confidence}});
    return json.dump(1) + "\n";
}

} // namespace skelgen::evaluation
