#pragma once

#include <cstdint>

#include <skelgen/core/mesh.hpp>

namespace skelgen::synth {

/// What a scanner does to a body. Lengths in metres.
struct ScanFaults {
    double noise = 0;         ///< standard deviation along the normals
    int holes = 0;            ///< patches of `patch_radius` left out
    int floating_pieces = 0;  ///< patches doubled somewhere off the body
    int flipped_patches = 0;  ///< patches whose faces look inwards
    int pinched_vertices = 0; ///< pairs of vertices made one: two fans of faces touch there
    double patch_radius = 0.03;
    std::uint64_t seed = 0;

    [[nodiscard]] bool any() const {
        return noise > 0 || holes + floating_pieces + flipped_patches + pinched_vertices > 0;
    }
};

/// The mesh with these faults at places drawn from the seed; vertices that no face uses are dropped. Faults may
/// overlap. O(faces * faults).
[[nodiscard]] TriangleMesh<double> with_scan_faults(const TriangleMesh<double>& mesh, const ScanFaults& faults);

} // namespace skelgen::synth
