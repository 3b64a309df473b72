#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/cross_section.hpp>

namespace skelgen::refinement {

/// Where a trunk's front is by its shape.
template <typename Scalar = double>
struct TrunkShape {
    Vector3<Scalar> forward = Vector3<Scalar>::Zero(); ///< unit, across the spine and the hips
    Scalar frontness = 0; ///< how much narrower than its back the belly is, in trunk lengths; 0: no difference
};

/// Measures the trunk between the middle of the hips and the neck by sections at a fifth to two fifths of its height:
/// there the back is broad and flat and the belly, fat or thin, is rounder. `across`: from hip to hip, any sense. None
/// when there is no section, or when `across` runs along the spine. O(n + m).
template <typename Scalar>
[[nodiscard]] std::optional<TrunkShape<Scalar>> measure_trunk(const Slicer<Scalar>& slicer, const Vector3<Scalar>& hips,
                                                              const Vector3<Scalar>& neck,
                                                              const Vector3<Scalar>& across);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/trunk_shape.hpp>
#endif
