#pragma once

#include <memory>
#include <optional>

#include <skelgen/synth/body.hpp>

namespace skelgen::synth {

/// A place on a person's skin, whoever it is and however he holds himself: seen from the bone of the part that the skin
/// is on.
struct SkinPlace {
    int part = 0; ///< of trunk, head and the limbs' parts, as they are counted inside
    int side = 0; ///< 1 on a left limb, -1 on a right one, 0 on trunk and head
    /// Along the part's bone, 0 to 1; of the trunk from 0 at the hips, to 1 at crotch, 2 at the waist, ... 5 at the
    /// head.
    double along = 0;
    /// From there, at rest: a direction of length 1; of hands and feet the place itself, relative to their size.
    Vector3<double> from_bone = Vector3<double>::Zero();
};

/// Which places of the skin the points of a generated body are, and back: so the same place is found on any two of
/// them. Where parts flow into each other, in folds that a ray from the bone meets elsewhere, on fingers, which bend by
/// themselves, on things that are carried, and where a part lies inside another one, nothing is known.
class SkinPlaces {
public:
    /// Of the body that `synthesize_body` made of that plan. \throws Error usage as that does.
    SkinPlaces(const BodyPlan& plan, const SynthBody& body);

    /// Where a point on the surface (to a hundredth of the height) is on the person. In the body's coordinates.
    [[nodiscard]] std::optional<SkinPlace> place_of(const Vector3<double>& point) const;

    /// The point of the surface, to a few millimetres, that is this place.
    [[nodiscard]] std::optional<Vector3<double>> point_at(const SkinPlace& place) const;

private:
    struct Skin;
    std::shared_ptr<const Skin> skin_;
};

} // namespace skelgen::synth
