#include <skelgen/evaluation/curve_error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::evaluation {
namespace {

using Vec3 = Vector3<double>;

constexpr double end_reach = 1.5;      ///< radii around an end in which distances say nothing
constexpr double junction_reach = 1.5; ///< radii around a junction in which its radius is the unit
constexpr double radius_reach = 2.5;   ///< radii around both in which a node's radius says nothing
constexpr double step = 0.125;         ///< of the comparison, in radii

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Graph {
    const Points<double>& nodes;
    const std::vector<std::array<int, 2>>& edges;
    std::vector<int> degree;
};

Graph graph_of(const Points<double>& nodes, const std::vector<std::array<int, 2>>& edges) {
    Graph graph{nodes, edges, std::vector<int>(static_cast<std::size_t>(nodes.rows()), 0)};
    for (const auto& edge : edges)
        for (const int node : edge) ++graph.degree[static_cast<std::size_t>(node)];
    return graph;
}

int ends_of(const Graph& graph) { return static_cast<int>(std::count(graph.degree.begin(), graph.degree.end(), 1)); }

int cycles_of(const Graph& graph) {
    std::vector<int> group(graph.degree.size());
    std::iota(group.begin(), group.end(), 0);
    const auto root = [&group](int v) {
        while (group[static_cast<std::size_t>(v)] != v) v = group[static_cast<std::size_t>(v)];
        return v;
    };
    int cycles = 0; // edges within what already hangs together
    for (const auto& [a, b] : graph.edges) {
        const int from = root(a), to = root(b);
        cycles += from == to ? 1 : 0;
        group[static_cast<std::size_t>(from)] = to;
    }
    return cycles;
}

/// Where on a graph a place is nearest.
struct Nearest {
    double distance = infinite;
    std::size_t edge = 0;
    double along = 0; ///< 0 at the edge's first node, 1 at its second
};

Nearest nearest_on(const Graph& graph, const Vec3& place) {
    Nearest nearest;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        const Vec3 a = core::point(graph.nodes, graph.edges[e][0]),
                   ab = core::point(graph.nodes, graph.edges[e][1]) - a;
        const double length2 = ab.squaredNorm();
        const double t = length2 > 0 ? std::clamp((place - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
        if (const double d = (a + t * ab - place).norm(); d < nearest.distance) nearest = {d, e, t};
    }
    return nearest;
}

struct Ball {
    Vec3 centre;
    double radius;
};

bool within(const std::vector<Ball>& balls, double reach, const Vec3& place) {
    return std::any_of(balls.begin(), balls.end(),
                       [&](const Ball& ball) { return (place - ball.centre).norm() <= reach * ball.radius; });
}

/// The axis with what is around it to be looked up.
class Axis {
public:
    explicit Axis(const io::AxisTruth& truth) : truth_(truth), graph_(graph_of(truth.nodes, truth.edges)) {
        std::vector<double> thickest = truth.radii; // of a node and its neighbours
        for (const auto& [a, b] : truth.edges)
            for (const auto& [at, other] : {std::pair(a, b), std::pair(b, a)}) {
                double& radius = thickest[static_cast<std::size_t>(at)];
                radius = std::max(radius, truth.radii[static_cast<std::size_t>(other)]);
            }
        for (std::size_t i = 0; i < thickest.size(); ++i) {
            const Vec3 place = core::point(truth.nodes, static_cast<Eigen::Index>(i));
            if (graph_.degree[i] == 1) ends_.push_back({place, truth.radii[i]});
            if (graph_.degree[i] > 2) junctions_.push_back({place, thickest[i]});
        }
    }

    [[nodiscard]] const Graph& graph() const { return graph_; }
    [[nodiscard]] const std::vector<Ball>& ends() const { return ends_; }
    [[nodiscard]] const std::vector<Ball>& junctions() const { return junctions_; }

    [[nodiscard]] double radius_at(const Nearest& nearest) const {
        const auto [a, b] = graph_.edges[nearest.edge];
        return (1 - nearest.along) * truth_.radii[static_cast<std::size_t>(a)] +
               nearest.along * truth_.radii[static_cast<std::size_t>(b)];
    }

    [[nodiscard]] double radius_at(const Vec3& place) const { return radius_at(nearest_on(graph_, place)); }

    /// What distances at a place are measured in.
    [[nodiscard]] double unit_at(const Vec3& place) const {
        double unit = radius_at(place);
        for (const Ball& junction : junctions_)
            if ((place - junction.centre).norm() <= junction_reach * junction.radius)
                unit = std::max(unit, junction.radius);
        return unit;
    }

private:
    const io::AxisTruth& truth_;
    Graph graph_;
    std::vector<Ball> ends_, junctions_;
};

std::vector<Ball> ends_with_radii(const Graph& curve, const Axis& axis) {
    std::vector<Ball> ends;
    for (std::size_t i = 0; i < curve.degree.size(); ++i)
        if (curve.degree[i] == 1) {
            const Vec3 place = core::point(curve.nodes, static_cast<Eigen::Index>(i));
            ends.push_back({place, axis.radius_at(place)});
        }
    return ends;
}

/// Places along a graph, each with the length of the graph that it stands for.
struct Sample {
    Vec3 place;
    double weight;
};

std::vector<Sample> samples_of(const Graph& graph, const Axis& axis) {
    std::vector<Sample> samples;
    for (const auto& edge : graph.edges) {
        const Vec3 a = core::point(graph.nodes, edge[0]), b = core::point(graph.nodes, edge[1]);
        const double length = (b - a).norm();
        const double radius = std::min(axis.radius_at(a), axis.radius_at(b));
        const int pieces = std::max(1, static_cast<int>(std::ceil(length / (step * radius))));
        for (int i = 0; i <= pieces; ++i)
            samples.push_back({a + (b - a) * i / pieces, (i == 0 || i == pieces ? 0.5 : 1.0) * length / pieces});
    }
    for (std::size_t i = 0; i < graph.degree.size(); ++i)
        if (graph.degree[i] == 0) samples.push_back({core::point(graph.nodes, static_cast<Eigen::Index>(i)), 0.0});
    return samples;
}

double end_error(const std::vector<Ball>& ends, const std::vector<Ball>& found) {
    double error = 0;
    for (const Ball& end : ends) {
        double nearest = infinite;
        for (const Ball& other : found) nearest = std::min(nearest, (end.centre - other.centre).norm() / end.radius);
        error = std::max(error, nearest);
    }
    return error;
}

double radius_error(const CurveSkeleton<double>& curve, const Axis& axis, const std::vector<Ball>& curve_ends) {
    double error = 0;
    for (std::size_t i = 0; i < curve.radii.size(); ++i) {
        const Vec3 place = core::point(curve.nodes, static_cast<Eigen::Index>(i));
        if (within(axis.ends(), radius_reach, place) || within(axis.junctions(), radius_reach, place) ||
            within(curve_ends, radius_reach, place))
            continue;
        const double radius = axis.radius_at(place);
        error = std::max(error, std::abs(curve.radii[i] - radius) / radius);
    }
    return error;
}

} // namespace

CurveError measure_curve(const CurveSkeleton<double>& curve, const io::AxisTruth& truth) {
    if (truth.edges.empty()) throw Error(ErrorCode::bad_input, "the true axis has no edges");
    const Axis axis(truth);
    const Graph found = graph_of(curve.nodes, curve.edges);
    const std::vector<Ball> curve_ends = ends_with_radii(found, axis);

    CurveError error;
    double weights = 0, sum = 0;
    const auto add = [&](const Sample& sample, double distance) {
        if (within(axis.ends(), end_reach, sample.place) || within(curve_ends, end_reach, sample.place)) return;
        const double relative = distance / axis.unit_at(sample.place);
        error.hausdorff = std::max(error.hausdorff, relative);
        sum += sample.weight * relative;
        weights += sample.weight;
    };
    std::vector<Vec3> lone_nodes; // part of the curve, though of none of its edges
    for (std::size_t i = 0; i < found.degree.size(); ++i)
        if (found.degree[i] == 0) lone_nodes.push_back(core::point(curve.nodes, static_cast<Eigen::Index>(i)));
    for (const Sample& sample : samples_of(axis.graph(), axis)) {
        double distance = nearest_on(found, sample.place).distance;
        for (const Vec3& node : lone_nodes) distance = std::min(distance, (node - sample.place).norm());
        add(sample, distance);
    }
    for (const Sample& sample : samples_of(found, axis)) add(sample, nearest_on(axis.graph(), sample.place).distance);
    error.mean = weights > 0 ? sum / weights : 0.0;
    error.radius_error = radius_error(curve, axis, curve_ends);
    error.end_error = end_error(axis.ends(), curve_ends);
    error.ends = ends_of(found);
    error.true_ends = io::end_count(truth);
    error.cycles = cycles_of(found);
    error.true_cycles = io::cycle_count(truth);
    return error;
}

} // namespace skelgen::evaluation
