#pragma once

#include <skelgen/search/extract_options.hpp>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/template_rules.hpp>

namespace skelgen::search {

SKELGEN_INLINE void validate(const ExtractOptions& options) {
    if (!options.skeleton_template.joints.empty()) validate_template(options.skeleton_template);
    surface::validate(options.prepare);
    curve::validate(options.curve);
    embedding::validate(options.matching);
    refinement::validate(options.refinement);
    core::require_in_range("budget", options.budget, 1, 1000);
    core::require_in_range("threads", options.threads, 1, 1024);
}

SKELGEN_INLINE SkeletonTemplate wanted_template(const ExtractOptions& options) {
    return options.skeleton_template.joints.empty() ? builtin_template("human21") : options.skeleton_template;
}

} // namespace skelgen::search
