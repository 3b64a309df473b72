#pragma once

#include <optional>

#include <skelgen/core/canonical_form.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/curve/manifold_parts.hpp>
#include <skelgen/extract.hpp>

namespace skelgen::detail {

/// The first half of the pipeline: the largest piece of the mesh in canonical coordinates, and the curve within.
struct BodyCurve {
    Similarity similarity;
    ManifoldParts<double> body; ///< `source` indexes the caller's vertices, -1 for those added
    CurveGraph<double> surface; ///< of `body`
    CurveSkeleton<double> curve;
};

/// \throws Error bad_input when `mesh` is no usable surface.
template <typename Scalar>
[[nodiscard]] BodyCurve find_body_curve(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options);

/// The body with its surface cut where it touches itself, and the curve that then has no loops; none when no way to cut
/// it lets the template in.
[[nodiscard]] std::optional<BodyCurve> part_contacts(const BodyCurve& found, const SkeletonTemplate& wanted,
                                                     const ExtractOptions& options);

} // namespace skelgen::detail
