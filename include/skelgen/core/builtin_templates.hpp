#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <skelgen/core/skeleton_template.hpp>

namespace skelgen {

/// Names of the templates that are part of skelgen, in alphabetical order.
[[nodiscard]] std::vector<std::string> builtin_template_names();

/// A template that is part of skelgen: `human21`, `pinocchio18` (BP07), or `quadruped`, a
/// four-legged animal. The reference stays valid until the program
/// ends. The same templates are the files data/templates/, for those who write their own.
/// \throws Error usage when there is none of that name; the message lists those there are.
[[nodiscard]] const SkeletonTemplate& builtin_template(std::string_view name);

} // namespace skelgen

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/core/impl/builtin_templates.hpp>
#endif
