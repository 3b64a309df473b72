#include "body_surface.hpp"

#include <algorithm>

namespace skelgen::synth {

ImplicitSurface surface_of(const ImplicitBody& body, const Proportions& proportions) {
    const Vector3<double> middle = body.skeleton().position(BodyJoint::crotch);
    double radius = 0;
    for (const auto& frame : body.skeleton().frames) radius = std::max(radius, (frame.translation() - middle).norm());
    return {[&body](const Vec3& p) { return body(p); }, [&body](const Vec3& p) { return body.grain(p); }, middle,
            radius + 0.25 * proportions.scale * proportions.head_scale + 0.1 * proportions.scale};
}

} // namespace skelgen::synth
