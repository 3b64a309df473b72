#include "body_surface.hpp"

#include <algorithm>

#include <skelgen/core/error.hpp>

#include "clothing.hpp"

namespace skelgen::synth {

ImplicitBody naked_field(const BodyPlan& plan, const Proportions& proportions) {
    ImplicitBody field(proportions, plan.pose, plan.hands);
    if (!plan.may_touch && field.clearance() < least_gap / 2 * proportions.scale)
        throw Error(ErrorCode::usage, "parts of the body touch or sink into each other in this pose: spread the limbs");
    for (const BodyJoint joint : plan.missing) field.leave_out(joint);
    return field;
}

ImplicitBody dressed_field(const BodyPlan& plan, const Proportions& proportions) {
    ImplicitBody field = naked_field(plan, proportions);
    for (const Garment garment : plan.clothes) put_on(field, proportions, garment);
    return field;
}

ImplicitSurface surface_of(const ImplicitBody& body, const Proportions& proportions) {
    const Vector3<double> middle = body.skeleton().position(BodyJoint::crotch);
    double radius = 0;
    for (const auto& frame : body.skeleton().frames) radius = std::max(radius, (frame.translation() - middle).norm());
    radius += 0.25 * proportions.scale * proportions.head_scale + 0.1 * proportions.scale;
    for (int i = 0; i < part_count; ++i) { // heads that are large for the body, and what they wear, reach further
        const Ball bound = body.part_bound(static_cast<PartName>(i));
        radius = std::max(radius, (bound.centre - middle).norm() + bound.radius);
    }
    radius = std::max(radius, body.reach_of_carried(middle) + 0.02 * proportions.scale);
    return {[&body](const Vec3& p) { return body(p); }, [&body](const Vec3& p) { return body.grain(p); }, middle,
            radius};
}

} // namespace skelgen::synth
