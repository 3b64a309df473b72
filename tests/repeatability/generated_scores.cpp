#include "generated_scores.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>

#include "spreads.hpp"

namespace skelgen::repeatability {
namespace {

/// The vertex of the second body's own surface that is the place of a vertex of the first one; -1 where it is not
/// known.
int true_vertex(const GeneratedBody& from, int vertex, const GeneratedBody& to) {
    const auto place = from.places.place_of(from.motion.undo(core::point(from.found.mesh.vertices, vertex)));
    if (!place) return -1;
    const auto point = to.places.point_at(*place);
    if (!point) return -1;
    const Vector3<double> there = to.motion.apply(*point);
    return to.found.stands_for[static_cast<std::size_t>(core::nearest_vertex(to.found.mesh, there))];
}

double distance_along(const Body<double>& body, int from, int to) {
    return core::shortest_paths(body.graph, from).distance[static_cast<std::size_t>(to)]; // of unit area
}

/// The skeleton with the joints and end points that the body was generated with.
KinematicSkeleton<double> true_skeleton(const GeneratedBody& body) {
    KinematicSkeleton<double> out = body.found.skeleton;
    for (std::size_t j = 0; j < body.made.truth.joints.size(); ++j) {
        const auto name = std::string(synth::joint_name(static_cast<synth::BodyJoint>(j)));
        if (const int joint = find_joint(out, name); joint >= 0)
            out.joints[static_cast<std::size_t>(joint)].position = body.motion.apply(body.made.truth.joints[j]);
    }
    for (auto& [end, place] : out.end_points)
        for (const auto& [name, truth] : body.made.truth.end_points)
            if (name == end) place = body.motion.apply(truth);
    return out;
}

} // namespace

CorrespondenceScores score_correspondences(const GeneratedSet& set, std::size_t step) {
    constexpr std::size_t samples = 200;
    CorrespondenceScores out;
    std::size_t sided = 0, exchanged = 0;
    for (std::size_t i = 0; i < set.bodies.size(); ++i) {
        const GeneratedBody &from = set.bodies[i],
                            &to = set.bodies[(i + places_on(step, set.bodies.size())) % set.bodies.size()];
        const auto start = std::chrono::steady_clock::now();
        const applications::Correspondence found = applications::correspond(from.found.comparable, to.found.comparable);
        out.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() /
                       static_cast<double>(set.bodies.size());
        const std::vector<int> from_mesh = applications::first_standing(from.found.surface, from.found.stands_for);
        const std::vector<int> to_mesh = applications::first_standing(to.found.surface, to.found.stands_for);
        double sum = 0;
        int known = 0;
        const std::size_t count = from.found.stands_for.size();
        for (std::size_t s = 0; s < std::min(samples, count); ++s) {
            const std::size_t v = s * count / std::min(samples, count);
            const auto of_body = static_cast<std::size_t>(from.found.stands_for[v]);
            const int sent_to = found.map[of_body], side = from.side_of(static_cast<int>(v));
            if (const int there = to_mesh[static_cast<std::size_t>(sent_to)]; side != 0 && there >= 0) {
                ++sided;
                if (side * to.side_of(there) < 0) ++exchanged;
            }
            const int truth = true_vertex(from, static_cast<int>(v), to);
            if (truth < 0) continue;
            const double error = distance_along(to.found.surface, truth, sent_to);
            sum += error, ++known;
            out.trusted.emplace_back(found.confidence[of_body], error);
        }
        if (known > 0) {
            out.errors.push_back(sum / known);
            out.pairs.push_back(from.plan.name + " on " + to.plan.name);
        }
        for (const applications::Landmark& mark : applications::landmarks(from.found.comparable, found)) {
            const int vertex = from_mesh[static_cast<std::size_t>(mark.from)];
            const int truth = vertex >= 0 ? true_vertex(from, vertex, to) : -1;
            if (truth >= 0) out.landmark_errors.push_back(distance_along(to.found.surface, truth, mark.to));
        }
    }
    out.exchanged = sided > 0 ? static_cast<double>(exchanged) / static_cast<double>(sided) : 0;
    return out;
}

std::vector<MeasureError> measure_errors(const GeneratedSet& set) {
    std::map<std::string, std::vector<double>> differences;
    std::map<std::string, int> without;
    for (const GeneratedBody& body : set.bodies) {
        const KinematicSkeleton<double> truth = true_skeleton(body);
        auto wanted = named_measures(
            applications::measure(body.found.surface, truth, applications::segment(body.found.surface, truth)));
        wanted["height"] = synth::complete_shape(body.plan.shape).height;
        const auto found = named_measures(body.found.measures);
        for (const auto& [name, value] : wanted) {
            if (const auto same = found.find(name); same != found.end() && value > 0)
                differences[name].push_back(std::abs(same->second / value - 1));
            else
                ++without[name];
        }
    }
    std::vector<MeasureError> out;
    for (const auto& [name, values] : differences) {
        double mean = 0;
        for (const double value : values) mean += value / static_cast<double>(values.size());
        out.push_back({name, mean, *std::max_element(values.begin(), values.end()), without[name]});
    }
    return out;
}

} // namespace skelgen::repeatability
