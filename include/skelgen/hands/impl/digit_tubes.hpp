#pragma once

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/hands/impl/hand_surface.hpp>
#include <skelgen/surface/contours.hpp>

namespace skelgen::hands {

/// A digit as the surface shows it, before it has a name: a tube that ends.
template <typename Scalar = double>
struct DigitTube {
    std::vector<Vector3<Scalar>> axis;        ///< from where it joins its neighbours to its end on the surface
    std::vector<Scalar> radii;                ///< per place on the axis: the girth there over two pi; 0 at the end
    std::vector<int> vertices;                ///< of the hand's surface beyond where it joins them
    std::vector<Vector3<Scalar>> points = {}; ///< where these are
    std::vector<Scalar> areas = {};           ///< of the surface around each
    Scalar joins = 0;      ///< distance from the forearm along the surface where it joins another one
    Scalar ends = 0;       ///< and that of its end
    bool is_alone = false; ///< there is no other: the axis is that of the hand's outer half
};

/// Which parts of a surface are digits, relative to the hand's length.
struct DigitBounds {
    double least = 0.1; ///< that they stand out by, calibrated: shorter stubs are knuckles and folds
    double nearest = 0; ///< distance from the forearm at which they join another one
};

namespace detail {

/// A maximum of the distance that stands out, and what is nearer to it than where it joins another one.
template <typename Scalar>
struct Peak {
    int tip = -1;
    Scalar ends = 0, joins = 0;
    bool goes_on = false; ///< beyond the hand's surroundings
};

template <typename Scalar>
struct Peaks {
    std::vector<Peak<Scalar>> peaks;
    std::vector<int> of_vertex; ///< per vertex its peak, -1 below all
};

/// Vertices are taken from the farthest one down: parts grow from maxima and meet at saddles.
template <typename Scalar>
class PartsFromAbove {
public:
    PartsFromAbove(const HandSurface<Scalar>& hand, Scalar least) : hand_(hand), least_(least) {
        out_.of_vertex.assign(hand.source.size(), -1);
        part_of_.assign(hand.source.size(), -1);
        std::vector<int> order(hand.source.size());
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(), [&](int a, int b) {
            return hand.distance[a] != hand.distance[b] ? hand.distance[a] > hand.distance[b] : a < b;
        });
        for (const int v : order) take(v);
        if (out_.peaks.empty()) take_all_as_one(order.front());
    }

    [[nodiscard]] Peaks<Scalar> peaks() && { return std::move(out_); }

private:
    struct Part {
        int tip;
        bool is_open = true; ///< it has met no other that stands out
        std::vector<int> vertices;
    };
    [[nodiscard]] Part& part(int p) { return parts_[static_cast<std::size_t>(p)]; }
    [[nodiscard]] Scalar top(int p) { return hand_.distance[part(p).tip]; }

    void take(int v) {
        std::vector<int> met;
        for (const auto& [w, length] : hand_.graph.neighbours[static_cast<std::size_t>(v)])
            if (const int p = part_of_[static_cast<std::size_t>(w)];
                p >= 0 && std::find(met.begin(), met.end(), p) == met.end())
                met.push_back(p);
        if (met.empty()) {
            met.push_back(static_cast<int>(parts_.size()));
            parts_.push_back({v, true, {}});
        }
        std::sort(met.begin(), met.end(), [&](int a, int b) { return top(a) != top(b) ? top(a) > top(b) : a < b; });
        const Scalar level = hand_.distance[v];
        const auto stands_out = [&](int p) { return !part(p).is_open || top(p) - level >= least_; };
        int into = met.front();
        for (std::size_t i = 1; i < met.size(); ++i) {
            int from = met[i];
            if (stands_out(into) && stands_out(from)) {
                close(into, level);
                close(from, level);
            } else if (stands_out(from)) {
                std::swap(into, from);
            }
            for (const int u : part(from).vertices) part_of_[static_cast<std::size_t>(u)] = into;
            std::vector<int>& all = part(into).vertices;
            all.insert(all.end(), part(from).vertices.begin(), part(from).vertices.end());
            part(from).vertices.clear();
        }
        part_of_[static_cast<std::size_t>(v)] = into;
        part(into).vertices.push_back(v);
    }

    void close(int p, Scalar level) {
        if (!part(p).is_open) return;
        part(p).is_open = false;
        add_peak(part(p).tip, level, part(p).vertices);
    }

    void add_peak(int tip, Scalar joins, const std::vector<int>& vertices) {
        Peak<Scalar> peak{tip, hand_.distance[tip], joins};
        for (const int v : vertices) {
            out_.of_vertex[static_cast<std::size_t>(v)] = static_cast<int>(out_.peaks.size());
            peak.goes_on = peak.goes_on || hand_.is_at_rim[static_cast<std::size_t>(v)];
        }
        out_.peaks.push_back(peak);
    }

    void take_all_as_one(int farthest) {
        const Scalar half = hand_.distance[farthest] / 2;
        std::vector<int> vertices;
        for (Eigen::Index v = 0; v < hand_.distance.size(); ++v)
            if (hand_.distance[v] >= half) vertices.push_back(static_cast<int>(v));
        add_peak(farthest, half, vertices);
    }

    const HandSurface<Scalar>& hand_;
    Scalar least_;
    std::vector<Part> parts_;
    std::vector<int> part_of_;
    Peaks<Scalar> out_;
};

/// A contour's centre by length, and its girth.
template <typename Scalar>
struct Ring {
    Vector3<Scalar> centre = Vector3<Scalar>::Zero();
    Scalar girth = 0;
};

template <typename Scalar>
Ring<Scalar> ring_of(const surface::Contour<Scalar>& contour) {
    Ring<Scalar> out;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
        const Vector3<Scalar>&p = contour.points[i], &q = contour.points[(i + 1) % contour.points.size()];
        const Scalar length = (q - p).norm();
        out.centre += length * (p + q) / 2;
        out.girth += length;
    }
    if (out.girth > 0) out.centre /= out.girth;
    return out;
}

/// The longest contour on that level around a peak.
template <typename Scalar>
Ring<Scalar> ring_around(const HandSurface<Scalar>& hand, const surface::LevelSets<Scalar>& levels,
                         const std::vector<int>& peak_of_vertex, int peak, Scalar level) {
    Ring<Scalar> longest;
    for (const surface::Contour<Scalar>& contour : levels.contours(level)) {
        bool is_own = false;
        for (int k = 0; k < 3; ++k) {
            const int v = hand.mesh.faces(contour.faces.front(), k);
            is_own = is_own || (hand.distance[v] >= level && peak_of_vertex[static_cast<std::size_t>(v)] == peak);
        }
        if (!is_own) continue;
        const Ring<Scalar> ring = ring_of(contour);
        if (ring.girth > longest.girth) longest = ring;
    }
    return longest;
}

} // namespace detail

/// The digits of a hand's surface: where distances from the forearm have maxima that stand out from where the parts
/// beyond them meet (persistence: EH08), within the bounds: knuckles and nails do not. Tubes
/// that leave the hand's surroundings are none, as what is held, or the body behind a hand that lies on it. Nor are
/// those that join the rest too far from knuckles or forearm, as the other hand's. Of more than five those that stand
/// out most are taken. A hand without any is one tube, if its end is there. In no order. `place` is in the surface's
/// unit. O(n log n).
template <typename Scalar>
std::vector<DigitTube<Scalar>> find_tubes(const HandSurface<Scalar>& hand, const HandPlace<Scalar>& place,
                                          const DigitBounds& bounds = {}) {
    // Digits of characters join their neighbours 0.6 from the knuckles, a cartoon's thumb 0.8, and 1.5 from the
    // forearm.
    constexpr Scalar farthest_web = 1;
    constexpr Scalar longest_way = Scalar(1.6); // over the surface, calibrated
    constexpr std::size_t most = 5;
    constexpr int rings = 24;
    constexpr std::size_t least_rings = 5;
    const Scalar length = place.length();
    const detail::Peaks<Scalar> found =
        detail::PartsFromAbove<Scalar>(hand, static_cast<Scalar>(bounds.least) * length).peaks();
    const surface::LevelSets<Scalar> levels(hand.mesh, hand.adjacency, hand.distance);
    const Eigen::VectorX<core::Accumulator> areas = core::vertex_areas(hand.mesh);
    std::vector<DigitTube<Scalar>> tubes;
    for (std::size_t i = 0; i < found.peaks.size(); ++i) {
        const detail::Peak<Scalar>& peak = found.peaks[i];
        if (peak.goes_on || peak.joins > longest_way * place.stretched()) continue;
        if (peak.joins < static_cast<Scalar>(bounds.nearest) * length) continue;
        DigitTube<Scalar> tube;
        tube.joins = peak.joins;
        tube.ends = peak.ends;
        tube.is_alone = found.peaks.size() == 1;
        for (int k = 0; k < rings; ++k) {
            // Not on the saddle itself, where the contour goes around both.
            const Scalar part = (static_cast<Scalar>(k) + Scalar(0.02)) / rings;
            const Scalar level = peak.joins + part * (peak.ends - peak.joins);
            const auto ring = detail::ring_around(hand, levels, found.of_vertex, static_cast<int>(i), level);
            if (!(ring.girth > 0)) continue;
            tube.axis.push_back(ring.centre);
            tube.radii.push_back(ring.girth / (2 * std::numbers::pi_v<Scalar>));
        }
        if (tube.axis.size() < least_rings) continue;
        if ((tube.axis.front() - place.knuckles).norm() > farthest_web * length) continue;
        tube.axis.push_back(core::point(hand.mesh.vertices, peak.tip));
        tube.radii.push_back(0);
        for (std::size_t v = 0; v < found.of_vertex.size(); ++v) {
            if (found.of_vertex[v] != static_cast<int>(i)) continue;
            tube.vertices.push_back(static_cast<int>(v));
            tube.points.push_back(core::point(hand.mesh.vertices, static_cast<Eigen::Index>(v)));
            tube.areas.push_back(static_cast<Scalar>(areas[static_cast<Eigen::Index>(v)]));
        }
        tubes.push_back(std::move(tube));
    }
    if (tubes.size() > most) {
        std::sort(tubes.begin(), tubes.end(),
                  [](const auto& a, const auto& b) { return a.ends - a.joins > b.ends - b.joins; });
        tubes.resize(most);
    }
    return tubes;
}

} // namespace skelgen::hands
