#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// How finely the contracted stand-in of the input is meshed.
struct ProxyOptions {
    int vertices = 3000; ///< approximate number of vertices, whatever the input's size
    int rounds = 4;      ///< rounds of split, collapse, flip and relax
};

/// A stand-in for a mesh.
struct Proxy {
    TriangleMesh<double> mesh;
    std::vector<int>
        source; ///< per vertex a nearby vertex of the original mesh on the same sheet of surface, -1 if unknown
};

/// A well-shaped triangulation of a manifold surface with about `options.vertices` vertices, however coarse, fine or
/// thin the input's triangles: isotropic remeshing with one target edge length (Botsch & Kobbelt 2004): collapse short
/// edges, split long ones, flip towards valence six, relax tangentially. Same topology as the input. Bounds the cost of
/// contraction and spares it degenerate triangles.
/// O(n log n). \throws Error bad_input when `mesh` is not manifold.
[[nodiscard]] Proxy build_proxy(const TriangleMesh<double>& mesh, const ProxyOptions& options = {});

} // namespace skelgen
