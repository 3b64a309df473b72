#pragma once

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/fitting/extract_options.hpp>
#include <skelgen/fitting/fitted_body.hpp>

namespace skelgen::fitting {

/// Makes one surface of a mesh by the gentlest remedy that serves, as what comes out shows: the first skeleton that is
/// sure, or the surest of all. Of several bodies none is taken unless the caller says which.
template <typename Scalar>
[[nodiscard]] Outcome<FittedBody<Scalar>>
fit_to_best_surface(const TriangleMesh<Scalar>& mesh, const SkeletonTemplate& wanted, const ExtractOptions& options);

} // namespace skelgen::fitting

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/fitting/impl/best_surface.hpp>
#endif
