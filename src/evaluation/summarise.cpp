#include <skelgen/evaluation/evaluate.hpp>

#include <algorithm>
#include <utility>

#include <skelgen/evaluation/statistics.hpp>

namespace skelgen::evaluation {
namespace {

/// Errors, and the mesh that each is from.
struct JointErrors {
    std::vector<double> errors;
    std::vector<std::string> meshes;
};

ErrorStatistics to_statistics(const JointErrors& sample) {
    const auto worst = std::max_element(sample.errors.begin(), sample.errors.end());
    ErrorStatistics statistics;
    statistics.count = sample.errors.size();
    statistics.mean = mean(sample.errors);
    statistics.median = percentile(sample.errors, 50);
    statistics.p95 = percentile(sample.errors, 95);
    statistics.worst = *worst;
    statistics.worst_mesh = sample.meshes[static_cast<std::size_t>(worst - sample.errors.begin())];
    return statistics;
}

using NamedErrors = std::vector<std::pair<std::string, double>>;

/// The solved meshes' errors joint by joint, in the order in which the joints first appear.
std::vector<std::pair<std::string, JointErrors>> group_by_joint(const SetScore& set, NamedErrors MeshScore::*errors) {
    std::vector<std::pair<std::string, JointErrors>> groups;
    for (const MeshScore& mesh : set.meshes) {
        if (!mesh.solved()) continue;
        for (const auto& [joint, error] : mesh.*errors) {
            auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == joint; });
            if (group == groups.end()) group = groups.insert(groups.end(), {joint, {}});
            group->second.errors.push_back(error);
            group->second.meshes.push_back(mesh.name);
        }
    }
    return groups;
}

std::optional<double> mean_share_inside(const SetScore& set) {
    std::vector<double> shares;
    for (const MeshScore& mesh : set.meshes)
        if (mesh.outside)
            shares.push_back(1 - static_cast<double>(mesh.outside->size()) /
                                     static_cast<double>(evaluated_joints(mesh.plan).size()));
    if (shares.empty()) return std::nullopt;
    return mean(shares);
}

template <typename Condition>
std::size_t count(const SetScore& set, const Condition& condition) {
    return static_cast<std::size_t>(std::count_if(set.meshes.begin(), set.meshes.end(), condition));
}

/// Of all errors, and of each joint's, ordered by name; none where there is none.
struct Statistics {
    std::optional<ErrorStatistics> all;
    std::vector<std::pair<std::string, ErrorStatistics>> per_joint;
};

Statistics statistics_of(const SetScore& set, NamedErrors MeshScore::*errors) {
    Statistics out;
    JointErrors all; // joint after joint: the mean's last digit depends on the order
    for (const auto& [joint, sample] : group_by_joint(set, errors)) {
        out.per_joint.emplace_back(joint, to_statistics(sample));
        all.errors.insert(all.errors.end(), sample.errors.begin(), sample.errors.end());
        all.meshes.insert(all.meshes.end(), sample.meshes.begin(), sample.meshes.end());
    }
    if (!all.errors.empty()) out.all = to_statistics(all);
    std::sort(out.per_joint.begin(), out.per_joint.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    return out;
}

} // namespace

SetSummary summarise(const SetScore& set) {
    SetSummary summary;
    summary.name = set.name;
    summary.meshes = set.meshes.size();
    summary.complete = count(set, [](const MeshScore& mesh) { return mesh.complete; });
    summary.limbs = count(set, [](const MeshScore& mesh) { return mesh.limbs; });
    summary.sides = count(set, [](const MeshScore& mesh) { return mesh.sides; });
    summary.solved = count(set, [](const MeshScore& mesh) { return mesh.solved(); });
    summary.not_bodies = count(set, [](const MeshScore& mesh) { return mesh.not_a_body; });
    summary.refused = count(set, [](const MeshScore& mesh) { return mesh.refused; });
    summary.inside = mean_share_inside(set);
    auto [all, per_joint] = statistics_of(set, &MeshScore::errors);
    auto [digits, per_digit] = statistics_of(set, &MeshScore::digits);
    summary.errors = std::move(all);
    summary.per_joint = std::move(per_joint);
    summary.digits = std::move(digits);
    summary.per_digit = std::move(per_digit);
    return summary;
}

} // namespace skelgen::evaluation
