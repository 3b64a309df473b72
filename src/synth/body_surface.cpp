#include "body_surface.hpp"

#include <algorithm>

namespace skelgen::synth {

ImplicitSurface surface_of(const ImplicitBody& body, const Proportions& proportions) {
    const Vector3<double> middle = body.skeleton().position(BodyJoint::crotch);
    double radius = 0;
    for (const auto& frame : body.skeleton().frames) radius = std::max(radius, (frame.translation() - middle).norm());
    radius += 0.25 * proportions.scale * proportions.head_scale + 0.1 * proportions.scale;
    for (int i = 0; i < part_count; ++i) { // heads that are large for the body, and what they wear, reach further
        const Ball bound = body.part_bound(static_cast<PartName>(i));
        radius = std::max(radius, (bound.centre - middle).norm() + bound.radius);
    }
    return {[&body](const Vec3& p) { return body(p); }, [&body](const Vec3& p) { return body.grain(p); }, middle,
            radius};
}

} // namespace skelgen::synth
