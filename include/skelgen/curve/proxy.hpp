#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::curve {

/// Most vertices that a proxy may have.
inline constexpr int most_proxy_vertices = 1'000'000;

/// How finely the contracted stand-in of the input is meshed.
struct ProxyOptions {
    int vertices = 3000; ///< approximate number of vertices, whatever the input's size; calibrated
    int rounds = 4;      ///< rounds of collapse, split, flip and relax; calibrated
};

/// \throws Error usage when an option is out of its range.
void validate(const ProxyOptions& options);

/// A stand-in for a mesh.
template <typename Scalar = double>
struct Proxy {
    TriangleMesh<Scalar> mesh;
    std::vector<int>
        source; ///< per vertex a nearby vertex of the original mesh on the same sheet of surface, -1 if unknown
};

/// A well-shaped triangulation of a manifold surface with about `options.vertices` vertices, however coarse, fine or
/// thin the input's triangles: isotropic remeshing with one target edge length (BK04 section 4): collapse short edges,
/// split long ones, flip towards valence six, relax tangentially. Same topology as the input. Bounds the cost of
/// contraction and spares it degenerate triangles. Any unit.
/// O(n log n). \throws Error bad_input when `mesh` is not manifold, has no area, or has triangles so long that
/// splitting them would take more than ten times `options.vertices` vertices; usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] Proxy<Scalar> build_proxy(const TriangleMesh<Scalar>& mesh, const ProxyOptions& options = {});

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/proxy.hpp>
#endif
