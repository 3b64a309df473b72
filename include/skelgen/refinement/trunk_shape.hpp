#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/cross_section.hpp>

namespace skelgen {

/// Where a trunk's front is by its shape.
struct TrunkShape {
    Vector3<double> forward = Vector3<double>::Zero(); ///< unit, across the spine and the hips
    double frontness = 0; ///< how much narrower than its back the belly is, in trunk lengths; 0: no difference
};

/// Measures the trunk between the middle of the hips and the neck by sections at a fifth to two fifths of its height:
/// there the back is broad and flat and the belly, fat or thin, is rounder. `across`: from hip to hip, any sense. None
/// when there is no section, or when `across` runs along the spine. O(n + m).
[[nodiscard]] std::optional<TrunkShape> measure_trunk(const Slicer& slicer, const Vector3<double>& hips,
                                                      const Vector3<double>& neck, const Vector3<double>& across);

} // namespace skelgen
