#pragma once

#include <optional>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::fitting {

/// Is it known that there is no body, whatever the curve?
template <typename T>
[[nodiscard]] bool is_refused(const Outcome<T>& outcome) {
    return !outcome && outcome.failure().reason != FailureReason::no_match;
}

/// The refusal of what is too compact to have arms and legs.
[[nodiscard]] Failure too_compact_a_shape();

/// A body reaches far for its surface: toe to fingertip takes 1.34 (very heavy, or in a coat) to 1.85 times (thin) the
/// square root of its area, drawn figures with large heads and short limbs 1.2; a ball 0.9, a toy koala 1, a dog 1.2,
/// two people hand in hand 2.2: measured on registered and generated bodies, figures and objects. `diameter` is
/// geodesic, for unit area; what may be a drawn figure is let in at `least_of_figures`.
inline constexpr double least_of_adults = 1.26, least_of_figures = 1.15, least_of_standing_figures = 1.1;

/// \returns a failure where a shape of unit area reaches less far over its surface than `least`, or farther than two
/// people hand in hand do nearly.
template <typename Scalar>
[[nodiscard]] std::optional<Failure> not_slender(Scalar diameter, double least);

/// A heavy body whose hands lie on it still reaches from head to toe, 1.05 times the square root of its area: what does
/// not is known to be none before its curve is looked for, which takes much longer.
template <typename Scalar>
[[nodiscard]] std::optional<Failure> too_compact(const Body<Scalar>& body);

/// So little distorted, per pair, the template is in whole bodies, and is to be without a limb in others: see
/// embedding::distortion_per_pair.
inline constexpr double well_fitted = 0.006;

/// What folds up and has grown together with itself reaches less far over its surface, while the longest
/// way along its curve stays as long as a body's: 1.04 to 1.22 times its reach over the surface on registered
/// bodies, 1.08 on average. Only what the template fits well is taken for such a one.
template <typename Scalar>
[[nodiscard]] bool is_folded_body(const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
                                  Scalar unmatched);

/// A person's arm, as a part of the curve: a sixth.
template <typename Scalar>
inline constexpr Scalar arm_of_curve = Scalar(0.17);

/// What goes on as far as a person's arm and belongs to no limb is another body's.
template <typename Scalar>
[[nodiscard]] std::optional<Failure> not_single(const CurveSkeleton<Scalar>& curve,
                                                const embedding::Embedding& embedding);

/// What belongs to no limb is no more than clothes, hair and weapons make. The skeleton is so much less certain as
/// there is of it. Calibrated on generated and real bodies, dressed ones among them (0.24 at most), and pairs of them.
template <typename Scalar>
[[nodiscard]] std::optional<Failure> not_all_matched(Scalar unmatched);

/// A joint of a limb in the midst of another limb, or of the trunk: the limb has been lost on the way to the curve.
/// Where limbs lie on each other their joints are farther from the other's bone than they are thick: 1.1 times the
/// radius at least on real bodies.
template <typename Scalar>
[[nodiscard]] std::optional<Failure> not_apart(const KinematicSkeleton<Scalar>& skeleton,
                                               const SkeletonTemplate& wanted);

} // namespace skelgen::fitting

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/fitting/impl/shape_gates.hpp>
#endif
