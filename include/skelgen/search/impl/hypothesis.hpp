#pragma once

#include <skelgen/search/hypothesis.hpp>

#include <algorithm>

#include <skelgen/core/header_only.hpp>

namespace skelgen::search {

SKELGEN_INLINE curve::CurveOptions curve_options(Effort effort, curve::CurveOptions wanted) {
    constexpr int least_vertices = 750;
    constexpr double more_firmly = 5, most_firmly = 1e6; // the latter as contract takes it
    int& vertices = wanted.proxy.vertices;
    if (effort == Effort::draft) {
        vertices = std::max(vertices / 2, std::min(vertices, least_vertices));
        double& weight = wanted.contraction.medial_weight;
        weight = std::min(more_firmly * weight, most_firmly);
    }
    if (effort == Effort::detailed || effort == Effort::more_detailed) wanted.pruning = curve::pruning_for_digits;
    if (effort == Effort::more_detailed) vertices = std::min(3 * vertices, curve::most_proxy_vertices);
    wanted.is_draft = true;
    return wanted;
}

SKELGEN_INLINE int cost_of(Effort effort) {
    switch (effort) {
    case Effort::draft:
    case Effort::rest_fit:
        return 1;
    case Effort::detailed:
        return 2;
    case Effort::more_detailed:
        return 4;
    case Effort::posed_fit: // needs no curve
        return 0;
    }
    return 1;
}

SKELGEN_INLINE std::string_view to_string(surface::Remedy remedy) {
    switch (remedy) {
    case surface::Remedy::largest_piece:
        return "largest_piece";
    case surface::Remedy::envelope:
        return "envelope";
    case surface::Remedy::rounded:
        return "rounded";
    case surface::Remedy::alike_pieces:
        return "alike_pieces";
    case surface::Remedy::bridged:
        return "bridged";
    }
    return "";
}

SKELGEN_INLINE std::string_view to_string(Effort effort) {
    switch (effort) {
    case Effort::draft:
        return "draft";
    case Effort::detailed:
        return "detailed";
    case Effort::more_detailed:
        return "more_detailed";
    case Effort::rest_fit:
        return "rest_fit";
    case Effort::posed_fit:
        return "posed_fit";
    }
    return "";
}

} // namespace skelgen::search
