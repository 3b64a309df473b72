#include "stroke_field.hpp"

#include <algorithm>
#include <limits>

#include <skelgen/core/geometry.hpp>

namespace skelgen::synth {
namespace {

constexpr double far_away = 1e3;
constexpr std::size_t chunk_size = 8;

Ball bound_of(const TubeStroke& stroke, std::size_t first, std::size_t last) {
    Vec3 low = stroke.line[first], high = low;
    for (std::size_t i = first; i <= last; ++i) {
        low = low.cwiseMin(stroke.line[i]);
        high = high.cwiseMax(stroke.line[i]);
    }
    Ball bound{(low + high) / 2, 0};
    for (std::size_t i = first; i <= last; ++i)
        bound.radius = std::max(bound.radius, (stroke.line[i] - bound.centre).norm() + stroke.aspect * stroke.radii[i]);
    return bound;
}

double gap(const Ball& ball, const Vec3& p) { return (p - ball.centre).norm() - ball.radius; }

} // namespace

StrokeField::Part StrokeField::to_part(const TubeStroke& stroke) {
    const std::size_t segments = stroke.line.size() - 1;
    Part part{stroke, {}, bound_of(stroke, 0, segments)};
    for (std::size_t first = 0; first < segments; first += chunk_size) {
        const std::size_t last = std::min(first + chunk_size, segments);
        part.chunks.push_back({first, last, bound_of(stroke, first, last)});
    }
    return part;
}

StrokeField::StrokeField(const std::vector<TubeStroke>& strokes) {
    parts_.reserve(strokes.size());
    for (const TubeStroke& stroke : strokes) parts_.push_back(to_part(stroke));
}

StrokeField::Nearest StrokeField::round_at(const Part& part, const Chunk& start, const Vec3& p) {
    const TubeStroke& stroke = part.stroke;
    Nearest nearest{far_away, 0};
    const auto look_at = [&](const Chunk& chunk) {
        for (std::size_t i = chunk.first; i < chunk.last; ++i) {
            const RoundCone cone{stroke.line[i], stroke.line[i + 1], stroke.radii[i], stroke.radii[i + 1]};
            if (const double value = cone(p); value < nearest.value) nearest = {value, stroke.radii[i]};
        }
    };
    look_at(start);
    for (const Chunk& chunk : part.chunks)
        if (gap(chunk.bound, p) < nearest.value) look_at(chunk);
    return nearest;
}

StrokeField::Nearest StrokeField::elliptic_at(const Part& part, const Chunk& start, const Vec3& p) {
    const TubeStroke& stroke = part.stroke;
    double distance = std::numeric_limits<double>::infinity(), along = 0;
    std::size_t segment = 0;
    const auto look_at = [&](const Chunk& chunk) {
        for (std::size_t i = chunk.first; i < chunk.last; ++i) {
            const auto nearest = core::nearest_on_segment(p, stroke.line[i], stroke.line[i + 1]);
            if (nearest.distance < distance) distance = nearest.distance, along = nearest.along, segment = i;
        }
    };
    look_at(start);
    // The ball holds the line and more: no point of the line is nearer than it.
    for (const Chunk& chunk : part.chunks)
        if (gap(chunk.bound, p) < distance) look_at(chunk);
    const auto between = [&](const auto& values) {
        return (1 - along) * values[segment] + along * values[segment + 1];
    };
    const double radius = between(stroke.radii);
    const Vec3 tangent = (stroke.line[segment + 1] - stroke.line[segment]).normalized();
    const Vec3 narrow = Vec3(between(stroke.wide)).cross(tangent).normalized();
    Ellipsoid section{between(stroke.line), {radius, stroke.aspect * radius, radius}, Mat3::Identity()};
    section.axes << narrow, tangent.cross(narrow), tangent;
    return {section(p), radius};
}

StrokeField::Nearest StrokeField::at(const Part& part, const Vec3& p) {
    const auto by_gap = [&p](const Chunk& a, const Chunk& b) { return gap(a.bound, p) < gap(b.bound, p); };
    const Chunk& start = *std::min_element(part.chunks.begin(), part.chunks.end(), by_gap);
    // Far from the tube, the distance to the balls around it is near enough to the field, and much faster.
    if (const double away = gap(start.bound, p); away > start.bound.radius)
        return {away, part.stroke.radii[start.first]};
    return part.stroke.wide.empty() ? round_at(part, start, p) : elliptic_at(part, start, p);
}

double StrokeField::operator()(const Vec3& p) const {
    double field = far_away;
    for (const Part& part : parts_)
        if (gap(part.bound, p) < field + part.stroke.blend)
            field = smooth_union(field, at(part, p).value, part.stroke.blend);
    return field;
}

double StrokeField::radius_at(const Vec3& p) const {
    Nearest nearest{far_away, 0};
    for (const Part& part : parts_)
        if (gap(part.bound, p) < nearest.value)
            if (const Nearest other = at(part, p); other.value < nearest.value) nearest = other;
    return nearest.radius;
}

} // namespace skelgen::synth
