#include "correspondences.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::repeatability {
namespace {

/// 1 on the left limbs, -1 on the right ones, 0 elsewhere.
int side_of(const RegisteredBody& body, std::size_t vertex) {
    return sign_of(split_side(body.bones.parts[static_cast<std::size_t>(body.bones.vertex_part[vertex])]).side);
}

/// Distance along the second body from where a vertex of the mesh truly is to a vertex of its surface.
double error_of(const RegisteredBody& to, int vertex, int found) {
    const int truth = to.stands_for[static_cast<std::size_t>(vertex)];
    return core::shortest_paths(to.surface.graph, truth).distance[static_cast<std::size_t>(found)]; // of unit area
}

} // namespace

CorrespondenceScores score_correspondences(const RegisteredSet& set) {
    constexpr std::size_t step = 17, samples = 100;
    CorrespondenceScores out;
    std::size_t sided = 0, exchanged = 0;
    for (std::size_t i = 0; i < set.bodies.size(); ++i) {
        const RegisteredBody& from = set.bodies[i];
        const RegisteredBody& to = set.bodies[(i + places_on(step, set.bodies.size())) % set.bodies.size()];
        const auto start = std::chrono::steady_clock::now();
        const applications::Correspondence found = applications::correspond(from.comparable, to.comparable);
        out.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() /
                       static_cast<double>(set.bodies.size());
        const auto sent_to = [&](std::size_t v) { return found.map[static_cast<std::size_t>(from.stands_for[v])]; };
        double sum = 0;
        for (std::size_t s = 0; s < samples; ++s) {
            const std::size_t v = s * from.stands_for.size() / samples;
            const double error = error_of(to, static_cast<int>(v), sent_to(v));
            sum += error / samples;
            out.trusted.emplace_back(found.confidence[static_cast<std::size_t>(from.stands_for[v])], error);
        }
        out.errors.push_back(sum);
        out.pairs.push_back(from.name + " on " + to.name);
        const std::vector<int> from_mesh = applications::first_standing(from.surface, from.stands_for);
        const std::vector<int> to_mesh = applications::first_standing(to.surface, to.stands_for);
        for (const applications::Landmark& mark : applications::landmarks(from.comparable, found))
            if (const int vertex = from_mesh[static_cast<std::size_t>(mark.from)]; vertex >= 0)
                out.landmark_errors.push_back(error_of(to, vertex, mark.to));
        for (std::size_t v = 0; v < from.stands_for.size(); ++v) {
            const int other = to_mesh[static_cast<std::size_t>(sent_to(v))];
            if (other < 0 || side_of(from, v) == 0) continue;
            ++sided;
            if (side_of(from, v) * side_of(to, static_cast<std::size_t>(other)) < 0) ++exchanged;
        }
    }
    out.exchanged = sided > 0 ? static_cast<double>(exchanged) / static_cast<double>(sided) : 0;
    return out;
}

} // namespace skelgen::repeatability
