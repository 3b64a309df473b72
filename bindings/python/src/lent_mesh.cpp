#include "lent_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <Eigen/Core>

namespace skelgen::python {
namespace {

// Eigen's matrices own their memory. Members that are private may be named where a template is instantiated explicitly
// ([temp.spec.general]), and so their pointers can be set to memory that Python owns.
#if EIGEN_WORLD_VERSION == 3 && EIGEN_MAJOR_VERSION == 4
constexpr bool can_lend = true;

template <typename Matrix, auto storage, auto data, auto rows>
struct Lender {
    friend void set_memory(Matrix& matrix, typename Matrix::Scalar* memory, Eigen::Index count) {
        (matrix.*storage).*data = memory;
        (matrix.*storage).*rows = count;
    }
};

using VertexStorage = Eigen::DenseStorage<double, Eigen::Dynamic, Eigen::Dynamic, 3, Eigen::RowMajor>;
using FaceStorage = Eigen::DenseStorage<int, Eigen::Dynamic, Eigen::Dynamic, 3, Eigen::RowMajor>;
void set_memory(Points<double>& matrix, double* memory, Eigen::Index count);
void set_memory(Triangles& matrix, int* memory, Eigen::Index count);
template struct Lender<Points<double>, &Eigen::PlainObjectBase<Points<double>>::m_storage, &VertexStorage::m_data,
                       &VertexStorage::m_rows>;
template struct Lender<Triangles, &Eigen::PlainObjectBase<Triangles>::m_storage, &FaceStorage::m_data,
                       &FaceStorage::m_rows>;
#else // another layout: copies
constexpr bool can_lend = false;
template <typename Matrix>
void set_memory(Matrix&, typename Matrix::Scalar*, Eigen::Index) {}
#endif

bool is_aligned(const void* memory) {
    return EIGEN_MAX_ALIGN_BYTES == 0 || reinterpret_cast<std::uintptr_t>(memory) % EIGEN_MAX_ALIGN_BYTES == 0;
}

/// Lends the matrix an array's memory, or copies it. The matrix is only read from.
template <typename Matrix, typename Array>
bool lend(Matrix& matrix, const Array& array) {
    using Scalar = typename Matrix::Scalar;
    const auto rows = static_cast<Eigen::Index>(array.shape(0));
    const bool lends = can_lend && rows > 0 && is_aligned(array.data());
    if (lends)
        set_memory(matrix, const_cast<Scalar*>(static_cast<const Scalar*>(array.data())), rows);
    else
        matrix = Eigen::Map<const Matrix, Eigen::Unaligned>(array.data(), rows, 3);
    return lends;
}

void require_finite(const Vertices& vertices) {
    const std::size_t count = vertices.size();
    const double* const end = vertices.data() + count;
    const double* const bad = std::find_if(vertices.data(), end, [](double x) { return !std::isfinite(x); });
    if (bad != end)
        throw nb::value_error(("vertices: the coordinates of vertex " + std::to_string((bad - vertices.data()) / 3) +
                               " are not finite, in an array of shape (" + std::to_string(count / 3) + ", 3)")
                                  .c_str());
}

void require_vertices(const Faces& faces, std::size_t vertices) {
    const std::size_t count = faces.size();
    const std::int32_t* const end = faces.data() + count;
    const std::int32_t* const bad = std::find_if(
        faces.data(), end, [&](std::int32_t v) { return v < 0 || static_cast<std::size_t>(v) >= vertices; });
    if (bad != end)
        throw nb::value_error(("faces: face " + std::to_string((bad - faces.data()) / 3) + " names vertex " +
                               std::to_string(*bad) + ", in an array of shape (" + std::to_string(count / 3) +
                               ", 3); there are " + std::to_string(vertices) + " vertices")
                                  .c_str());
}

} // namespace

LentMesh::LentMesh(const Vertices& vertices, const Faces& faces) {
    require_finite(vertices);
    require_vertices(faces, vertices.shape(0));
    lends_vertices_ = lend(mesh_.vertices, vertices);
    lends_faces_ = lend(mesh_.faces, faces);
}

LentMesh::~LentMesh() {
    if (lends_vertices_) set_memory(mesh_.vertices, nullptr, 0);
    if (lends_faces_) set_memory(mesh_.faces, nullptr, 0);
}

} // namespace skelgen::python
