#pragma once

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::test {

/// A body of that mesh as it stands: neither moved, turned nor scaled.
template <typename Scalar>
Body<Scalar> body_of(const TriangleMesh<Scalar>& mesh) {
    std::vector<int> source(static_cast<std::size_t>(mesh.vertices.rows()));
    std::iota(source.begin(), source.end(), 0);
    return surface::make_body(mesh, {}, std::move(source), 0);
}

/// A body of that mesh scaled to unit area, as the pipeline does, in the precision asked for.
template <typename Scalar = double>
Body<Scalar> unit_body(TriangleMesh<double> mesh) {
    mesh.vertices /= std::sqrt(core::surface_area(mesh));
    return body_of(TriangleMesh<Scalar>{mesh.vertices.template cast<Scalar>(), mesh.faces});
}

} // namespace skelgen::test
