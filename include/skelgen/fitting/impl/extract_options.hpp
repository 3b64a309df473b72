#pragma once

#include <skelgen/fitting/extract_options.hpp>

#include <algorithm>

#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/template_rules.hpp>

namespace skelgen::fitting {

SKELGEN_INLINE void validate(const ExtractOptions& options) {
    if (!options.skeleton_template.joints.empty()) validate_template(options.skeleton_template);
    surface::validate(options.prepare);
    curve::validate(options.curve);
    embedding::validate(options.matching);
    refinement::validate(options.refinement);
    symmetry::validate(options.sides);
    core::require_in_range("threads", options.threads, 1, 1024);
}

SKELGEN_INLINE ExtractOptions for_first_try(ExtractOptions options) {
    constexpr int least_vertices = 750;
    constexpr double more_firmly = 5, most_firmly = 1e6; // the latter as contract takes it
    int& vertices = options.curve.proxy.vertices;
    vertices = std::max(vertices / 2, std::min(vertices, least_vertices));
    double& weight = options.curve.contraction.medial_weight;
    weight = std::min(more_firmly * weight, most_firmly);
    options.curve.is_draft = true;
    return options;
}

} // namespace skelgen::fitting
