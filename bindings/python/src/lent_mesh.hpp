#pragma once

#include <cstdint>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <skelgen/core/mesh.hpp>

namespace skelgen::python {

namespace nb = nanobind;

/// n x 3 coordinates and m x 3 vertex indices that Python owns.
using Vertices = nb::ndarray<const double, nb::numpy, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Faces = nb::ndarray<const std::int32_t, nb::numpy, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

/// Arrays of Python's as the mesh that the library takes, without a copy: for as long as it lives, the mesh's matrices
/// lie in the arrays' memory. Arrays at addresses that Eigen cannot load from are copied.
class LentMesh {
public:
    /// \throws nb::value_error when a coordinate is not finite or a face names no vertex: Python may have changed the
    /// arrays since they were last looked at. O(n).
    LentMesh(const Vertices& vertices, const Faces& faces);
    LentMesh(const LentMesh&) = delete;
    LentMesh& operator=(const LentMesh&) = delete;
    ~LentMesh();

    [[nodiscard]] const TriangleMesh<double>& operator*() const { return mesh_; }

private:
    TriangleMesh<double> mesh_;
    bool lends_vertices_ = false, lends_faces_ = false;
};

} // namespace skelgen::python
