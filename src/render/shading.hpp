#pragma once

#include <Eigen/Core>

#include "palette.hpp"

namespace skelgen::render {

/// Red, green, blue multiplied by the opacity, and the opacity.
using Layer = Eigen::Array4f;

/// `above` laid over `below`.
[[nodiscard]] inline Layer over(const Layer& above, const Layer& below) { return above + (1.0f - above[3]) * below; }

/// The skin towards the viewer. `normal`: unit, in picture axes with y UP; `ambient`: 0 to 1.
[[nodiscard]] Layer shade_skin(const Eigen::Vector3f& normal, float ambient);

/// Opaque skin of that colour (each 0 to 1). `normal` and `ambient` as above.
[[nodiscard]] Layer shade_painted_skin(const Eigen::Vector3f& normal, float ambient, const Eigen::Array3f& colour);

/// The skin on the far side, seen through the body from within; `normal` points to the viewer.
[[nodiscard]] Layer shade_far_skin(const Eigen::Vector3f& normal, float ambient);

/// A bone, joint or curve: opaque, with a darker rim. `normal` as above.
[[nodiscard]] Layer shade_solid(const Eigen::Vector3f& normal, const Colour& colour);

} // namespace skelgen::render
