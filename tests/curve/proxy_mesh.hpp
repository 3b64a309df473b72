#pragma once

#include <skelgen/curve/proxy.hpp>

namespace skelgen::test {

/// The same mesh in another precision.
template <typename Scalar>
TriangleMesh<Scalar> mesh_in(const TriangleMesh<double>& mesh) {
    return {mesh.vertices.template cast<Scalar>(), mesh.faces};
}

/// What contraction works on: a well-shaped mesh of about `vertices` vertices.
template <typename Scalar>
TriangleMesh<Scalar> proxy_mesh(const TriangleMesh<Scalar>& mesh, int vertices = 1500) {
    curve::ProxyOptions options;
    options.vertices = vertices;
    return curve::build_proxy(mesh, options).mesh;
}

} // namespace skelgen::test
