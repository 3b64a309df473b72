#include <skelgen/evaluation/curve_error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
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

/// Where on a curve a place is nearest.
struct Nearest {
    double distance = infinite;
    std::size_t edge = 0;
    double along = 0; ///< 0 at the edge's first node, 1 at its second
};

Nearest nearest_on(const CurveSkeleton<double>& curve, const Vec3& place) {
    Nearest nearest;
    for (std::size_t e = 0; e < curve.edges.size(); ++e) {
        const auto [a, b] = curve.edges[e];
        const auto [distance, along] =
            core::nearest_on_segment(place, core::point(curve.nodes, a), core::point(curve.nodes, b));
        if (distance < nearest.distance) nearest = {distance, e, along};
    }
    return nearest;
}

/// The places of the nodes without edges.
std::vector<Vec3> lone_nodes(const CurveSkeleton<double>& curve) {
    std::vector<Vec3> places;
    for (const int node : core::nodes_of_degree(curve, 0)) places.push_back(core::point(curve.nodes, node));
    return places;
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
    explicit Axis(const CurveSkeleton<double>& curve) : curve_(curve) {
        std::vector<double> thickest = curve.radii; // of a node and its neighbours
        for (const auto& [a, b] : curve.edges)
            for (const auto& [at, other] : {std::pair(a, b), std::pair(b, a)}) {
                double& radius = thickest[static_cast<std::size_t>(at)];
                radius = std::max(radius, curve.radii[static_cast<std::size_t>(other)]);
            }
        const core::CurveGraph<double> graph = core::curve_graph(curve);
        for (int node = 0; node < graph.size(); ++node) {
            const Vec3 place = core::point(curve.nodes, node);
            if (graph.degree(node) == 1) ends_.push_back({place, curve.radii[static_cast<std::size_t>(node)]});
            if (graph.degree(node) > 2) junctions_.push_back({place, thickest[static_cast<std::size_t>(node)]});
        }
    }

    [[nodiscard]] const std::vector<Ball>& ends() const { return ends_; }
    [[nodiscard]] const std::vector<Ball>& junctions() const { return junctions_; }

    [[nodiscard]] double radius_at(const Nearest& nearest) const {
        const auto [a, b] = curve_.edges[nearest.edge];
        return (1 - nearest.along) * curve_.radii[static_cast<std::size_t>(a)] +
               nearest.along * curve_.radii[static_cast<std::size_t>(b)];
    }

    [[nodiscard]] double radius_at(const Vec3& place) const { return radius_at(nearest_on(curve_, place)); }

    /// What distances at a place are measured in.
    [[nodiscard]] double unit_at(const Vec3& place) const {
        double unit = radius_at(place);
        for (const Ball& junction : junctions_)
            if ((place - junction.centre).norm() <= junction_reach * junction.radius)
                unit = std::max(unit, junction.radius);
        return unit;
    }

private:
    const CurveSkeleton<double>& curve_;
    std::vector<Ball> ends_, junctions_;
};

std::vector<Ball> ends_with_radii(const CurveSkeleton<double>& curve, const Axis& axis) {
    std::vector<Ball> ends;
    for (const int node : core::nodes_of_degree(curve, 1)) {
        const Vec3 place = core::point(curve.nodes, node);
        ends.push_back({place, axis.radius_at(place)});
    }
    return ends;
}

/// Places along a curve, each with the length of the curve that it stands for.
struct Sample {
    Vec3 place;
    double weight;
};

std::vector<Sample> samples_of(const CurveSkeleton<double>& curve, const Axis& axis) {
    std::vector<Sample> samples;
    for (const auto& edge : curve.edges) {
        const Vec3 a = core::point(curve.nodes, edge[0]), b = core::point(curve.nodes, edge[1]);
        const double length = (b - a).norm();
        const double radius = std::min(axis.radius_at(a), axis.radius_at(b));
        const int pieces = std::max(1, static_cast<int>(std::ceil(length / (step * radius))));
        for (int i = 0; i <= pieces; ++i)
            samples.push_back({a + (b - a) * i / pieces, (i == 0 || i == pieces ? 0.5 : 1.0) * length / pieces});
    }
    for (const Vec3& place : lone_nodes(curve)) samples.push_back({place, 0.0});
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

CurveError measure_curve(const CurveSkeleton<double>& curve, const CurveSkeleton<double>& truth) {
    if (truth.edges.empty()) throw Error(ErrorCode::bad_input, "the true axis has no edges");
    if (truth.radii.size() != static_cast<std::size_t>(truth.nodes.rows()))
        throw Error(ErrorCode::bad_input, "the true axis does not have one radius for each node");
    const Axis axis(truth);
    const std::vector<Ball> curve_ends = ends_with_radii(curve, axis);
    const std::vector<Vec3> lone = lone_nodes(curve); // part of the curve, though of none of its edges

    CurveError error;
    double weights = 0, sum = 0;
    const auto add = [&](const Sample& sample, double distance) {
        if (within(axis.ends(), end_reach, sample.place) || within(curve_ends, end_reach, sample.place)) return;
        const double relative = distance / axis.unit_at(sample.place);
        error.hausdorff = std::max(error.hausdorff, relative);
        sum += sample.weight * relative;
        weights += sample.weight;
    };
    for (const Sample& sample : samples_of(truth, axis)) {
        double distance = nearest_on(curve, sample.place).distance;
        for (const Vec3& node : lone) distance = std::min(distance, (node - sample.place).norm());
        add(sample, distance);
    }
    for (const Sample& sample : samples_of(curve, axis)) add(sample, nearest_on(truth, sample.place).distance);
    error.mean = weights > 0 ? sum / weights : 0.0;
    error.radius_error = radius_error(curve, axis, curve_ends);
    error.end_error = end_error(axis.ends(), curve_ends);
    error.ends = core::end_count(curve);
    error.true_ends = core::end_count(truth);
    error.cycles = core::cycle_count(curve);
    error.true_cycles = core::cycle_count(truth);
    return error;
}

} // namespace skelgen::evaluation
