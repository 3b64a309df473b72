#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/refinement/centreline.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/limbs.hpp>

namespace skelgen::refinement {

/// The way from the trunk through the throat to the top of what the head ends in, along the curve.
template <typename Scalar = double>
struct ThroatOnCurve {
    Points<Scalar> line;   ///< k x 3, outwards
    Scalar arc = 0;        ///< arc length on it of the throat
    Vector3<Scalar> place; ///< there
    Vector3<Scalar> up;    ///< the line's unit direction there
    Scalar girth = 0;      ///< radius of the largest ball inside of what is beyond
};

namespace detail {

/// How far an adult's throat is below the top of the head along the curve, in the distance from the neck's joint to the
/// top. Calibrated: median of 88 bodies, as the next one.
template <typename Scalar>
inline constexpr Scalar adult_throat_on_curve = Scalar(0.80);

/// The radius of the largest ball inside of an adult's head, in the same unit.
template <typename Scalar>
inline constexpr Scalar adult_girth = Scalar(0.263);

/// How far below the throat the neck's joint is, in the same unit: as place_neck() has it.
template <typename Scalar>
inline constexpr Scalar neck_below_throat = Scalar(0.11);

/// A curve from the trunk to the end of a limb, and the radii of the balls inside of the surface around it.
template <typename Scalar>
struct CurveToEnd {
    Points<Scalar> points;
    Eigen::VectorX<Scalar> radii;
};

template <typename Scalar>
CurveToEnd<Scalar> curve_to(int end, const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding) {
    const auto chain = std::find_if(embedding.chains.begin(), embedding.chains.end(),
                                    [&](const embedding::Chain& each) { return each.joints.back() == end; });
    if (chain == embedding.chains.end()) return {};
    const auto count = static_cast<Eigen::Index>(chain->nodes.size());
    CurveToEnd<Scalar> out{Points<Scalar>(count, 3), Eigen::VectorX<Scalar>(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const int node = chain->nodes[static_cast<std::size_t>(i)];
        out.points.row(i) = curve.nodes.row(node);
        out.radii[i] = curve.radii[static_cast<std::size_t>(node)];
    }
    return out;
}

/// Samples to both sides from which a tangent of the curve is taken.
inline constexpr Eigen::Index curve_tangent_reach = 2;

/// Thickness of the sections across a curve; 0 at its ends and where there is none.
template <typename Scalar>
Eigen::VectorX<Scalar> thickness_along(const CurveToEnd<Scalar>& curve, const Slicer<Scalar>& slicer) {
    Eigen::VectorX<Scalar> out = Eigen::VectorX<Scalar>::Zero(curve.points.rows());
    for (Eigen::Index i = 1; i + 1 < curve.points.rows(); ++i)
        if (const auto section = slicer.around(core::point(curve.points, i),
                                               core::tangent_at(curve.points, i, curve_tangent_reach), curve.radii[i]))
            out[i] = section->thickness;
    return out;
}

} // namespace detail

/// The throat: of the sections along the curve to the head that are far thinner than the trunk before them and clearly
/// thinner than the head beyond, the thinnest. None where the embedding has no curve that ends in `head`, a joint of
/// the template, or it shows no throat. O(nodes log m).
template <typename Scalar>
std::optional<ThroatOnCurve<Scalar>> find_throat_on_curve(int head, const CurveSkeleton<Scalar>& curve,
                                                          const embedding::Embedding& embedding,
                                                          const Slicer<Scalar>& slicer) {
    constexpr Scalar trunk = Scalar(1.6), clearly_thicker = Scalar(1.15); // in a throat's thickness; working values
    constexpr Scalar least_head = Scalar(1) / 3; // of the trunk's ball: what is thinner is a horn; a working value
    const detail::CurveToEnd<Scalar> way = detail::curve_to(head, curve, embedding);
    const Eigen::Index count = way.points.rows();
    if (count < 3) return std::nullopt;
    const Eigen::VectorX<Scalar> thickness = detail::thickness_along(way, slicer);
    Eigen::VectorX<Scalar> before = thickness; // the largest so far
    for (Eigen::Index i = 1; i < count; ++i) before[i] = std::max(before[i - 1], thickness[i]);

    Eigen::Index throat = 0;
    Scalar beyond = 0, ball = 0, girth = 0; // the largest ones farther out; beyond the throat
    for (Eigen::Index i = count - 1; i-- > 1;) {
        const bool is_throat = thickness[i] > 0 && trunk * thickness[i] < before[i] &&
                               clearly_thicker * thickness[i] < beyond && ball > least_head * way.radii.maxCoeff();
        if (is_throat && (throat == 0 || thickness[i] < thickness[throat])) {
            throat = i;
            girth = ball;
        }
        beyond = std::max(beyond, thickness[i]);
        ball = std::max(ball, way.radii[i]);
    }
    if (throat == 0) return std::nullopt;
    return ThroatOnCurve<Scalar>{way.points, core::arc_lengths(way.points)[throat], core::point(way.points, throat),
                                 core::tangent_at(way.points, throat, detail::curve_tangent_reach), girth};
}

/// Has the limb its neck in the head, clearly beyond the throat? `adult`: the distance from an adult's neck to the top.
template <typename Scalar>
bool has_neck_in_head(const Limb<Scalar>& limb, const ThroatOnCurve<Scalar>& throat, Scalar adult) {
    constexpr Scalar clearly = Scalar(0.3); // 0.21 at most on 96 bodies whose heads are bare
    return limb.joints.size() > 1 && (point_on(limb, arc_of(limb, 0)) - throat.place).dot(throat.up) > clearly * adult;
}

/// How much farther than an adult's the joint of a head that is `size` times as large lies from where it is measured
/// from, the top or, under a hat, the neck. A child's is as far as an adult's. From two years on people have heads of
/// less than 1.5 times an adult's for their height; larger ones are drawn figures', whose joint goes with the head:
/// wholly from 2 on.
template <typename Scalar>
Scalar head_joint_growth(Scalar size) {
    constexpr Scalar most_of_people = Scalar(1.5), figure = 2;
    const Scalar drawn = std::clamp((size - most_of_people) / (figure - most_of_people), Scalar(0), Scalar(1));
    return 1 + drawn * (size - 1);
}

/// The head's limb as if it wore nothing, for heads that end in a hat, in horns, or in hair that stands up: it ends at
/// the crown, as high above the throat as a head of that girth is, and has its joints below that. `limb`: neck and head
/// at an adult's distances from the tip. O(k (n + m)).
template <typename Scalar>
Limb<Scalar> without_headgear(Limb<Scalar> limb, const ThroatOnCurve<Scalar>& throat, const Slicer<Scalar>& slicer,
                              const CentrelineOptions& options = {}) {
    const Scalar size = throat.girth / (detail::adult_girth<Scalar> * limb.from_tip.front());
    const Scalar height = size * limb.from_tip.front(), crown = detail::adult_throat_on_curve<Scalar> * height;
    const Scalar first = throat.arc - height / 2; // more than what the neck needs
    const Eigen::VectorX<Scalar> arc = core::arc_lengths(throat.line);
    const int steps =
        std::max(2, static_cast<int>(std::ceil((throat.arc + crown - first) / static_cast<Scalar>(options.step))));
    Points<Scalar> line(steps + 1, 3);
    for (int i = 0; i <= steps; ++i)
        core::set_point<Scalar>(
            line, i,
            core::point_at(throat.line, arc, first + (throat.arc + crown - first) * Scalar(i) / Scalar(steps)));
    limb.line = draw_centreline(slicer, line, options);
    const Scalar joint_above_neck = limb.from_tip.front() - limb.from_tip.back();
    limb.from_tip.front() = crown + detail::neck_below_throat<Scalar> * height;
    limb.from_tip.back() = limb.from_tip.front() - head_joint_growth(size) * joint_above_neck;
    limb.attachment = 0;
    return limb;
}

} // namespace skelgen::refinement
