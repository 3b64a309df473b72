#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// What joins the closed parts of a body that do not touch: legs of boxes below a trunk, a head that floats above it.
/// The parts are taken into one from the largest on, always that with the narrowest gap, by a prism between the middles
/// of the two sides where the gap is about as narrow as that, half as wide as the slighter part is thick. Parts of less
/// than a hundredth of the largest one's volume, and gaps wider than a part is thick, stay. \returns the prisms, as
/// closed surfaces that look outwards and reach into both parts; none where nothing is to be joined. Any unit.
/// O(k^2 n log n) for the k <= 24 largest parts.
template <typename Scalar>
[[nodiscard]] std::vector<TriangleMesh<Scalar>> bridges_between(const std::vector<TriangleMesh<Scalar>>& parts);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/bridges.hpp>
#endif
