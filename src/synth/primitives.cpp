#include "primitives.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace skelgen::synth {
namespace {

/// Slope at the middle of three points that keeps the interpolant monotone (Fritsch and Carlson's harmonic mean).
double monotone_slope(double before, double after) {
    return before * after <= 0 ? 0.0 : 2 * before * after / (before + after);
}

double hermite(double a, double slope_a, double b, double slope_b, double width, double u) {
    const double u2 = u * u, u3 = u2 * u;
    return a * (2 * u3 - 3 * u2 + 1) + slope_a * width * (u3 - 2 * u2 + u) + b * (3 * u2 - 2 * u3) +
           slope_b * width * (u3 - u2);
}

Ring secant(const Ring& a, const Ring& b) {
    const double width = b.at - a.at;
    return {0, (b.side - a.side) / width, (b.front - a.front) / width, (b.back - a.back) / width};
}

std::vector<Ring> slopes_of(const std::vector<Ring>& rings) {
    std::vector<Ring> slopes(rings.size(), Ring{0, 0, 0, 0});
    for (std::size_t i = 1; i + 1 < rings.size(); ++i) {
        const Ring before = secant(rings[i - 1], rings[i]), after = secant(rings[i], rings[i + 1]);
        slopes[i] = {0, monotone_slope(before.side, after.side), monotone_slope(before.front, after.front),
                     monotone_slope(before.back, after.back)};
    }
    return slopes;
}

/// |u|^(n-1), the common case without a call of pow.
double power_less_one(double u, double n) { return n == 2 ? u : n == 2.5 ? u * std::sqrt(u) : std::pow(u, n - 1); }

double root(double x, double n) { return std::pow(x, 1 / n); }

Ball bound_of(const Tube& tube) { return tube.bound(); }

Ball bound_of(const Ellipsoid& e) { return {e.centre, e.radii.maxCoeff()}; }

Ball bound_of(const RoundCone& c) {
    return {(c.from + c.to) / 2, (c.to - c.from).norm() / 2 + std::max(c.from_radius, c.to_radius)};
}

Ball bound_of(const HalfSpace&) { return {Vec3::Zero(), std::numeric_limits<double>::infinity()}; }

Tube grown_form(const Tube& tube, double distance) { return tube.grown(distance); }

Ellipsoid grown_form(Ellipsoid e, double distance) {
    e.radii.array() += distance;
    return e;
}

RoundCone grown_form(RoundCone c, double distance) {
    c.from_radius += distance, c.to_radius += distance;
    return c;
}

HalfSpace grown_form(HalfSpace h, double distance) {
    h.offset += distance;
    return h;
}

} // namespace

Tube::Tube(std::vector<Ring> rings, double exponent, double low_cap, double high_cap)
    : rings_(std::move(rings)), slopes_(slopes_of(rings_)), exponent_(exponent), low_cap_(low_cap),
      high_cap_(high_cap) {
    assert(rings_.size() >= 2);
    assert(std::is_sorted(rings_.begin(), rings_.end(), [](const Ring& a, const Ring& b) { return a.at < b.at; }));
}

Ring Tube::ring(double at) const {
    if (at <= rings_.front().at) return rings_.front();
    if (at >= rings_.back().at) return rings_.back();
    std::size_t i = 1;
    while (rings_[i].at < at) ++i;
    const Ring &a = rings_[i - 1], &b = rings_[i], &da = slopes_[i - 1], &db = slopes_[i];
    const double width = b.at - a.at, u = (at - a.at) / width;
    return {at, hermite(a.side, da.side, b.side, db.side, width, u),
            hermite(a.front, da.front, b.front, db.front, width, u),
            hermite(a.back, da.back, b.back, db.back, width, u)};
}

Ball Tube::bound() const {
    const double low = rings_.front().at - low_cap_, high = rings_.back().at + high_cap_;
    double wide = 0;
    for (const Ring& r : rings_) wide = std::max(wide, std::hypot(r.side, std::max(r.front, r.back)));
    return {{0, 0, (low + high) / 2}, std::hypot((high - low) / 2, wide)};
}

Tube Tube::grown(double distance) const {
    std::vector<Ring> rings = rings_;
    for (Ring& ring : rings) ring.side += distance, ring.front += distance, ring.back += distance;
    return {std::move(rings), exponent_, low_cap_ + distance, high_cap_ + distance};
}

double Tube::operator()(const Vec3& p) const {
    const Ring r = ring(p.z());
    const double depth = (r.front + r.back) / 2;
    const double y = p.y() - (r.back - r.front) / 2;
    const double over = p.z() < rings_.front().at  ? (rings_.front().at - p.z()) / low_cap_
                        : p.z() > rings_.back().at ? (p.z() - rings_.back().at) / high_cap_
                                                   : 0.0;
    const double cap = p.z() < rings_.front().at ? low_cap_ : high_cap_;
    const double u = std::abs(p.x()) / r.side, v = std::abs(y) / depth;
    const double un = power_less_one(u, exponent_), vn = power_less_one(v, exponent_);
    const double flat = exponent_ == 2 ? std::sqrt(u * u + v * v) : root(un * u + vn * v, exponent_);
    const double level = over == 0 ? flat : std::sqrt(flat * flat + over * over);
    if (level < 1e-9) return -std::min(r.side, depth);
    // The gradient of `level`: level = 1 is the surface, (level - 1) / |gradient| about the distance to it.
    const double scale = flat < 1e-9 ? 0.0 : 1 / power_less_one(flat, exponent_);
    const double share = flat / level;
    const double gx = share * scale * un / r.side, gy = share * scale * vn / depth, gz = over / level / cap;
    return (level - 1) / std::sqrt(gx * gx + gy * gy + gz * gz);
}

double Ellipsoid::operator()(const Vec3& p) const {
    const Vec3 scaled = (axes.transpose() * (p - centre)).cwiseQuotient(radii);
    const double level = scaled.norm();
    if (level < 1e-9) return -radii.minCoeff();
    return level * (level - 1) / scaled.cwiseQuotient(radii).norm();
}

double RoundCone::operator()(const Vec3& p) const {
    const Vec3 axis = to - from;
    const double length = axis.norm();
    const double along = (p - from).dot(axis) / length;
    const double away = std::sqrt(std::max(0.0, (p - from).squaredNorm() - along * along));
    const double slope = (to_radius - from_radius) / length;
    assert(std::abs(slope) < 1);
    // The ball that reaches nearest to p: the minimum of |p - centre(t)| - radius(t).
    const double t = std::clamp(along + slope * away / std::sqrt(1 - slope * slope), 0.0, length);
    return std::sqrt((along - t) * (along - t) + away * away) - (from_radius + slope * t);
}

double smooth_union(double a, double b, double blend) {
    const double overlap = blend - std::abs(a - b);
    return std::min(a, b) - (overlap > 0 ? overlap * overlap / (4 * blend) : 0.0);
}

double smooth_intersection(double a, double b, double blend) { return -smooth_union(-a, -b, blend); }

Blob grown(const Blob& blob, double distance) {
    Blob result = blob;
    std::visit([&](const auto& form) { result.form = grown_form(form, distance); }, blob.form);
    return result;
}

void set_bounds(std::vector<Blob>& blobs) {
    for (Blob& blob : blobs) blob.bound = std::visit([](const auto& form) { return bound_of(form); }, blob.form);
}

double evaluate(const std::vector<Blob>& blobs, const Vec3& p, double outside) {
    double field = outside;
    for (const Blob& blob : blobs) {
        // Out of reach of the blend: the blob changes nothing.
        const double reach = blob.bound.radius + blob.blend + (blob.use == Use::carve ? -field : field);
        if (reach <= 0 || (p - blob.bound.centre).squaredNorm() > reach * reach) continue;
        const double value = std::visit([&p](const auto& form) { return form(p); }, blob.form);
        switch (blob.use) {
        case Use::add:
            field = smooth_union(field, value, blob.blend);
            break;
        case Use::carve:
            field = smooth_intersection(field, -value, blob.blend);
            break;
        case Use::keep:
            field = smooth_intersection(field, value, blob.blend);
            break;
        }
    }
    return field;
}

} // namespace skelgen::synth
