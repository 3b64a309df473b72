#pragma once

#include <skelgen/refinement/trunk_shape.hpp>

#include <skelgen/core/precision.hpp>

namespace skelgen::refinement {
namespace detail {

/// How far from the line between hips and neck a trunk's section may be that does not enclose it, in that line's
/// length. A working value: the sections of a bent body lie off that line.
template <typename Scalar>
inline constexpr Scalar trunk_section_reach = Scalar(0.5);

} // namespace detail

template <typename Scalar>
std::optional<TrunkShape<Scalar>> measure_trunk(const Slicer<Scalar>& slicer, const Vector3<Scalar>& hips,
                                                const Vector3<Scalar>& neck, const Vector3<Scalar>& across) {
    const Scalar length = (neck - hips).norm();
    const Vector3<Scalar> up = (neck - hips) / length;
    const Vector3<Scalar> ahead = across.cross(up);
    if (!(ahead.norm() > core::rounding<Scalar>() * across.norm())) return std::nullopt;
    TrunkShape<Scalar> out;
    out.forward = ahead.normalized();
    Scalar egg = 0, sections = 0;
    for (const Scalar height : {Scalar(0.2), Scalar(0.3), Scalar(0.4)}) {
        const auto section =
            slicer.around(hips + height * (neck - hips), up, detail::trunk_section_reach<Scalar> * length);
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

} // namespace skelgen::refinement
