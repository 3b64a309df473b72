#pragma once

#include <skelgen/core/builtin_templates.hpp>

namespace skelgen::test {

inline const SkeletonTemplate& human() { return builtin_template("human21"); }

} // namespace skelgen::test
