#include <skelgen/synth/tubes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/synth/body.hpp>

#include "stroke_field.hpp"
#include "surface_mesher.hpp"

namespace skelgen::synth {
namespace {

constexpr double spacing = 0.25; ///< of the nodes over a cap, in radii

/// The graph of all lines; equal points are one node.
class AxisBuilder {
public:
    void add(const TubeStroke& stroke) {
        int before = -1;
        for (std::size_t i = 0; i < stroke.line.size(); ++i) {
            const int node = node_at(stroke.line[i], stroke.radii[i]);
            if (before >= 0) join(before, node);
            before = node;
        }
    }

    /// Carries the end on to the pole of its cap, unless something else is joined to it.
    void add_cap(const Vec3& end, const Vec3& before_end, double radius) {
        int node = node_at(end, radius);
        if (degree_[static_cast<std::size_t>(node)] != 1) return;
        const Vec3 direction = (end - before_end).normalized();
        const int steps = static_cast<int>(std::lround(1 / spacing));
        for (int step = 1; step <= steps; ++step) {
            const int next = node_at(end + radius * step / steps * direction, radius);
            join(node, next);
            node = next;
        }
    }

    [[nodiscard]] CurveSkeleton<double> truth() const {
        CurveSkeleton<double> result;
        result.nodes.resize(static_cast<Eigen::Index>(nodes_.size()), 3);
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            core::set_point(result.nodes, static_cast<Eigen::Index>(i), nodes_[i]);
        result.edges = edges_;
        result.radii = radii_;
        return result;
    }

private:
    /// A node that several tubes share has the radius of the thickest one.
    int node_at(const Vec3& p, double radius) {
        const auto [found, is_new] =
            known_.try_emplace(std::array<double, 3>{p.x(), p.y(), p.z()}, static_cast<int>(nodes_.size()));
        if (is_new) {
            nodes_.push_back(p);
            radii_.push_back(radius);
            degree_.push_back(0);
        }
        double& known = radii_[static_cast<std::size_t>(found->second)];
        known = std::max(known, radius);
        return found->second;
    }

    void join(int a, int b) {
        edges_.push_back({std::min(a, b), std::max(a, b)});
        ++degree_[static_cast<std::size_t>(a)];
        ++degree_[static_cast<std::size_t>(b)];
    }

    std::vector<Vec3> nodes_;
    std::vector<double> radii_;
    std::vector<int> degree_;
    std::vector<std::array<int, 2>> edges_;
    std::map<std::array<double, 3>, int> known_;
};

CurveSkeleton<double> truth_of(const std::vector<TubeStroke>& strokes) {
    AxisBuilder builder;
    for (const TubeStroke& stroke : strokes) builder.add(stroke);
    for (const TubeStroke& stroke : strokes) {
        const std::size_t last = stroke.line.size() - 1;
        builder.add_cap(stroke.line[0], stroke.line[1], stroke.radii[0]);
        builder.add_cap(stroke.line[last], stroke.line[last - 1], stroke.radii[last]);
    }
    return builder.truth();
}

/// The point of a line nearest to the middle of everything: whence the surface lies within the smallest ball.
Vec3 middle_of(const CurveSkeleton<double>& truth) {
    const Vec3 middle = (truth.nodes.colwise().minCoeff() + truth.nodes.colwise().maxCoeff()).transpose() / 2;
    return core::point(truth.nodes, core::nearest_point(truth.nodes, middle));
}

ImplicitSurface surface_of(const std::vector<TubeStroke>& strokes, const StrokeField& field, const Vec3& middle) {
    double thickest = 0, reach = 0;
    for (const TubeStroke& stroke : strokes)
        for (std::size_t i = 0; i < stroke.line.size(); ++i) {
            thickest = std::max(thickest, stroke.radii[i]);
            reach = std::max(reach, (stroke.line[i] - middle).norm() + 1.1 * stroke.aspect * stroke.radii[i]);
        }
    // Thinner tubes get smaller triangles, but not as many around as thick ones: faces of a scan are more even.
    return {[&field](const Vec3& p) { return field(p); },
            [&field, thickest](const Vec3& p) { return std::sqrt(field.radius_at(p) / thickest); }, middle, reach};
}

void check(const TubePlan& plan, const SynthTube& tube) {
    const auto require = [&plan](bool holds, const char* what) {
        if (!holds) throw Error(ErrorCode::internal, "the tubes of " + plan.name + " have " + what);
    };
    require(core::end_count(tube.truth) == plan.ends, "not the ends that are planned");
    require(core::cycle_count(tube.truth) == plan.cycles, "not the cycles that are planned");
    const Topology topology = topology_of(tube.mesh);
    require(topology.closed_manifold && topology.components == 1, "not one closed surface");
    require(topology.euler == 2 - 2 * plan.cycles, "a surface with other handles than their axis has cycles");
}

} // namespace

SynthTube synthesize_tube(const TubePlan& plan, int faces) {
    if (faces < least_faces || faces > most_faces)
        throw Error(ErrorCode::usage, std::to_string(faces) + " faces is out of range: give " +
                                          std::to_string(least_faces) + " to " + std::to_string(most_faces));
    const StrokeField field(plan.strokes);
    SynthTube tube;
    tube.truth = truth_of(plan.strokes);
    tube.mesh = mesh_surface(surface_of(plan.strokes, field, middle_of(tube.truth)), faces, plan.cycles == 0);
    check(plan, tube);
    return tube;
}

std::string curve_truth_to_json(const CurveSkeleton<double>& truth, const std::string& mesh_file) {
    using Json = nlohmann::ordered_json;
    Json nodes = Json::array();
    for (Eigen::Index i = 0; i < truth.nodes.rows(); ++i)
        nodes.push_back({truth.nodes(i, 0), truth.nodes(i, 1), truth.nodes(i, 2)});
    Json json;
    json["mesh"] = mesh_file;
    json["source"] = "skelgen synth: exact by construction";
    json["axis"] = {{"nodes", nodes}, {"edges", truth.edges}, {"radii", truth.radii}};
    json["ends"] = core::end_count(truth);
    json["cycles"] = core::cycle_count(truth);
    // One list of numbers a line would make the file ten times as long.
    return json.dump() + "\n";
}

} // namespace skelgen::synth
