#pragma once

#include <optional>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
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

/// The throat: of the sections along the curve to the head that are far thinner than the trunk before them and clearly
/// thinner than the head beyond, the thinnest. None where the embedding has no curve that ends in `head`, a joint of
/// the template, or it shows no throat. O(nodes log m).
template <typename Scalar>
[[nodiscard]] std::optional<ThroatOnCurve<Scalar>> find_throat_on_curve(int head, const CurveSkeleton<Scalar>& curve,
                                                                        const embedding::Embedding& embedding,
                                                                        const Slicer<Scalar>& slicer);

/// Has the limb its neck in the head, clearly beyond the throat? `adult`: the distance from an adult's neck to the top.
template <typename Scalar>
[[nodiscard]] bool has_neck_in_head(const Limb<Scalar>& limb, const ThroatOnCurve<Scalar>& throat, Scalar adult);

/// The head's limb as if it wore nothing, for heads that end in a hat, in horns, or in hair that stands up: it ends at
/// the crown, as high above the throat as a head of that girth is, and has its joints below that. `limb`: neck and head
/// at an adult's distances from the tip. O(k (n + m)).
template <typename Scalar>
[[nodiscard]] Limb<Scalar> without_headgear(Limb<Scalar> limb, const ThroatOnCurve<Scalar>& throat,
                                            const Slicer<Scalar>& slicer, const CentrelineOptions& options = {});

/// How much farther than an adult's the joint of a head that is `size` times as large lies from where it is measured
/// from, the top or, under a hat, the neck. A child's is as far as an adult's. From two years on people have heads of
/// less than 1.5 times an adult's for their height; larger ones are drawn figures', whose joint goes with the head:
/// wholly from 2 on.
template <typename Scalar>
[[nodiscard]] Scalar head_joint_growth(Scalar size);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/headgear.hpp>
#endif
