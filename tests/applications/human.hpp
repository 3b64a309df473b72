#pragma once

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/core/builtin_templates.hpp>

namespace skelgen::test {

inline const SkeletonTemplate& human() { return builtin_template("human21"); }

/// Its joints' axes in its rest pose.
inline const applications::Orientations<double>& human_axes() {
    static const auto axes = applications::rest_axes<double>(human());
    return axes;
}

} // namespace skelgen::test
