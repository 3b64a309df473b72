#pragma once

#include <skelgen/curve/proxy.hpp>

namespace skelgen::test {

/// What contraction works on: a well-shaped mesh of about `vertices` vertices.
inline TriangleMesh<double> proxy_mesh(const TriangleMesh<double>& mesh, int vertices = 1500) {
    ProxyOptions options;
    options.vertices = vertices;
    return build_proxy(mesh, options).mesh;
}

} // namespace skelgen::test
