#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/refinement/bone_line.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/profile_matcher.hpp>

namespace skelgen::refinement {

/// When an elbow or a knee shows where it is.
struct BendOptions {
    double from = 25; ///< degrees; below, it is straight and placed by length ratio
    double full = 45; ///< degrees; above, it is placed by its bones' lines; between, blended
    double weight =
        0.7; ///< from the centreline to where the lines meet; calibrated on registered and landmarked bodies
};

/// \throws Error usage when an option is out of its range.
inline void validate(const BendOptions& options) {
    core::require_in_range("refinement.bend.from", options.from, 0.0, 179.0);
    core::require_in_range("refinement.bend.full", options.full, options.from + 1, 180.0);
    core::require_in_range("refinement.bend.weight", options.weight, 0.0, 2.0);
}

/// The two bones at an elbow or a knee.
template <typename Scalar = double>
struct BonesAtBend {
    Vector3<Scalar> meeting; ///< middle of the lines' common perpendicular
    Scalar bent = 0;         ///< how much the joint counts as bent: 0 up to `BendOptions::from`, 1 from `full` on
};

/// The bones at the joint that is at arc length `here` of the limb's centreline, between the joints at `inner` and
/// `outer`, by the sections away from all three. None where either shows too few sections of its own, or where they are
/// parallel. As fit_bone.
template <typename Scalar>
[[nodiscard]] std::optional<BonesAtBend<Scalar>> bones_at_bend(const Limb<Scalar>& limb, Scalar inner, Scalar here,
                                                               Scalar outer, const BendOptions& options = {},
                                                               const BoneLineOptions& bone_line = {});

/// Where a limb is folded, as distances from its tip along the centreline, which cuts the corner there: how much longer
/// the way along both bones is. Of a straight limb nothing is folded.
template <typename Scalar = double>
struct Fold {
    Scalar nearer = 0, farther = 0; ///< from the tip: the part whose sections hold flesh of both bones
    Scalar longer = 0;              ///< along the bones than along the centreline
    Scalar bent = 0;                ///< see BonesAtBend

    /// Distance from the tip along the bones, of what is at that distance along the centreline.
    [[nodiscard]] Scalar along_bones(Scalar from_tip) const {
        if (from_tip <= nearer) return from_tip;
        if (from_tip >= farther) return from_tip + longer;
        return nearer + (from_tip - nearer) * (1 + longer / (farther - nearer));
    }
    [[nodiscard]] bool holds(Scalar from_tip) const { return from_tip > nearer && from_tip < farther; }
};

/// The fold of a limb whose joints are roughly at these distances from its tip: about the place where its bones' lines
/// meet, which a bend shows better than anything else. O(k^3) for k sections.
template <typename Scalar>
[[nodiscard]] Fold<Scalar> find_fold(const Limb<Scalar>& limb, const Stretch<Scalar>& joints,
                                     const BendOptions& options = {}, const BoneLineOptions& bone_line = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/bend.hpp>
#endif
