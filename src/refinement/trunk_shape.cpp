#include <skelgen/refinement/trunk_shape.hpp>

namespace skelgen {

std::optional<TrunkShape> measure_trunk(const Slicer& slicer, const Vector3<double>& hips, const Vector3<double>& neck,
                                        const Vector3<double>& across) {
    const double length = (neck - hips).norm();
    const Vector3<double> up = (neck - hips) / length;
    TrunkShape out;
    out.forward = across.cross(up).normalized();
    if (!(out.forward.norm() > 0.5)) return std::nullopt;
    double egg = 0, sections = 0;
    for (const double height : {0.2, 0.3, 0.4}) {
        const auto section = slicer.around(hips + height * (neck - hips), up, 0.5 * length);
        if (!section) continue;
        egg += egg_shape(*section, out.forward);
        sections += 1;
    }
    if (!(sections > 0)) return std::nullopt;
    out.frontness = egg / sections / length;
    if (out.frontness < 0) {
        out.forward = -out.forward;
        out.frontness = -out.frontness;
    }
    return out;
}

} // namespace skelgen
