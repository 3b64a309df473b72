#pragma once

#include <skelgen/surface/canonical_form.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/sort_by_number.hpp>

namespace skelgen::surface {
namespace detail {

using core::Accumulator;

/// A sum over the faces of a mesh, to which `add(sum, face)` adds one: of large meshes in blocks of about one size, and
/// then over the blocks, so that it is the same by however many threads.
template <typename Sum, typename Add>
Sum summed_over_faces(Eigen::Index faces, const Sum& zero, const Add& add) {
    constexpr Eigen::Index most_in_block = 1 << 17;
    const Eigen::Index blocks = std::max<Eigen::Index>(1, (faces + most_in_block - 1) / most_in_block);
    const Eigen::Index in_block = (faces + blocks - 1) / blocks;
    std::vector<Sum> sums(static_cast<std::size_t>(blocks), zero);
    core::parallel_for(sums.size(), 1, [&](std::size_t b) {
        const Eigen::Index begin = static_cast<Eigen::Index>(b) * in_block;
        Sum sum = zero;
        for (Eigen::Index f = begin; f < std::min(faces, begin + in_block); ++f) add(sum, f);
        sums[b] = sum;
    });
    Sum all = sums.front();
    for (std::size_t b = 1; b < sums.size(); ++b) all += sums[b];
    return all;
}

/// Sums over all faces, hence in the accumulator's precision.
struct FirstMoments {
    Accumulator area = 0;
    Vector3<Accumulator> centroid = Vector3<Accumulator>::Zero();

    FirstMoments& operator+=(const FirstMoments& other) {
        area += other.area;
        centroid += other.centroid;
        return *this;
    }
};

struct SurfaceMoments : FirstMoments {
    std::vector<Accumulator> areas;                                                         ///< of the faces
    Eigen::Matrix<Accumulator, 3, 3> covariance = Eigen::Matrix<Accumulator, 3, 3>::Zero(); ///< its lower triangle
};

template <typename Scalar>
Vector3<Accumulator> corner(const TriangleMesh<Scalar>& mesh, Eigen::Index f, int k) {
    const int v = mesh.faces(f, k);
    return {mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)};
}

/// Exact first and second moments of the surface, independent of how it is triangulated.
template <typename Scalar>
SurfaceMoments surface_moments(const TriangleMesh<Scalar>& mesh) {
    using Matrix = Eigen::Matrix<Accumulator, 3, 3>;
    SurfaceMoments out;
    out.areas.resize(static_cast<std::size_t>(mesh.faces.rows()));
    const auto add_first = [&](FirstMoments& moments, Eigen::Index f) {
        const Accumulator area = core::face_area_vector(mesh, f).norm();
        out.areas[static_cast<std::size_t>(f)] = area;
        moments.area += area;
        const Vector3<Accumulator> sum = corner(mesh, f, 0) + corner(mesh, f, 1) + corner(mesh, f, 2);
        moments.centroid += area / 3 * sum;
    };
    static_cast<FirstMoments&>(out) = summed_over_faces(mesh.faces.rows(), FirstMoments(), add_first);
    if (!(out.area > 0)) return out;
    out.centroid /= out.area;
    const auto add_second = [&](Matrix& covariance, Eigen::Index f) {
        const Accumulator weight = out.areas[static_cast<std::size_t>(f)] / 12;
        Vector3<Accumulator> sum = Vector3<Accumulator>::Zero();
        const auto add = [&](const Vector3<Accumulator>& d) {
            for (int i = 0; i < 3; ++i)
                for (int k = 0; k <= i; ++k) covariance(i, k) += weight * d[i] * d[k];
        };
        for (int k = 0; k < 3; ++k) {
            const Vector3<Accumulator> d = corner(mesh, f, k) - out.centroid;
            add(d);
            sum += d;
        }
        add(sum);
    };
    out.covariance = summed_over_faces(mesh.faces.rows(), Matrix(Matrix::Zero()), add_second) / out.area;
    return out;
}

/// The mean of points, summed up in the accumulator's precision.
template <typename Scalar>
Vector3<Scalar> mean_of(const Points<Scalar>& points) {
    Vector3<Accumulator> sum = Vector3<Accumulator>::Zero();
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        sum += Vector3<Accumulator>(points(i, 0), points(i, 1), points(i, 2));
    return (sum / static_cast<Accumulator>(points.rows())).template cast<Scalar>();
}

/// Third moments of the surface along three directions, over the faces' centres.
template <typename Scalar>
Vector3<Accumulator> skewness(const TriangleMesh<Scalar>& mesh, const SurfaceMoments& moments,
                              const std::array<Vector3<Accumulator>, 3>& axes) {
    const auto add = [&](Vector3<Accumulator>& sum, Eigen::Index f) {
        const Accumulator area = moments.areas[static_cast<std::size_t>(f)];
        const Vector3<Accumulator> from_centroid[3] = {corner(mesh, f, 0) - moments.centroid,
                                                       corner(mesh, f, 1) - moments.centroid,
                                                       corner(mesh, f, 2) - moments.centroid};
        for (std::size_t k = 0; k < 3; ++k) {
            Accumulator along = 0;
            for (const Vector3<Accumulator>& place : from_centroid) along += axes[k].dot(place);
            along /= 3;
            sum[static_cast<Eigen::Index>(k)] += area * (along * along * along);
        }
    };
    return summed_over_faces(mesh.faces.rows(), Vector3<Accumulator>(Vector3<Accumulator>::Zero()), add);
}

/// Principal axes as the rows of a rotation, longest first. The senses of the two most skewed ones follow their third
/// moments; the remaining one, across which a mirror-symmetric body has none, completes the right-handed triple.
template <typename Scalar>
Eigen::Matrix<Accumulator, 3, 3> principal_rotation(const TriangleMesh<Scalar>& mesh, const SurfaceMoments& moments) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Accumulator, 3, 3>> solver(moments.covariance);
    std::array<Vector3<Accumulator>, 3> axes;
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(k)][i] = solver.eigenvectors()(i, 2 - k);
    const Vector3<Accumulator> sums = skewness(mesh, moments, axes);
    std::array<Accumulator, 3> skew{sums[0], sums[1], sums[2]};
    for (std::size_t k = 0; k < 3; ++k) {
        if (skew[k] < 0) axes[k] = -axes[k];
        skew[k] = std::abs(skew[k]);
    }
    const auto least = static_cast<std::size_t>(std::min_element(skew.begin(), skew.end()) - skew.begin());
    axes[least] = axes[(least + 1) % 3].cross(axes[(least + 2) % 3]);
    Eigen::Matrix<Accumulator, 3, 3> rotation;
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) rotation(k, i) = axes[static_cast<std::size_t>(k)][i];
    return rotation;
}

/// Vertices in the order of their height along a direction askew to the axes, on which the two halves of a symmetric
/// body do not tie. In the accumulator's precision: in float a hundred thousand heights would have many ties.
template <typename Scalar>
std::vector<int> geometric_order(const Points<Scalar>& vertices) {
    const Vector3<Accumulator> askew(1, 0.7548776662466927, 0.5698402909980532);
    std::vector<std::pair<Accumulator, int>> heights;
    heights.reserve(static_cast<std::size_t>(vertices.rows()));
    for (int v = 0; v < static_cast<int>(vertices.rows()); ++v)
        heights.emplace_back(askew.dot(Vector3<Accumulator>(vertices(v, 0), vertices(v, 1), vertices(v, 2))), v);
    std::vector<int> order;
    order.reserve(heights.size());
    for (const auto& [height, v] : core::sorted_by_number(std::move(heights))) order.push_back(v);
    return order;
}

/// Faces on renumbered vertices, each from its lowest one on, in ascending order.
inline Triangles sorted_faces(const Triangles& faces, const std::vector<int>& new_index) {
    struct Face {
        int low, second, third;
    };
    const auto renumbered = [&](Eigen::Index f) {
        int corners[3];
        for (int k = 0; k < 3; ++k) corners[k] = new_index[static_cast<std::size_t>(faces(f, k))];
        const auto low = std::min_element(corners, corners + 3) - corners;
        return Face{corners[low], corners[(low + 1) % 3], corners[(low + 2) % 3]};
    };
    std::vector<std::size_t> begin(new_index.size() + 1, 0); // of each lowest vertex's faces
    for (Eigen::Index f = 0; f < faces.rows(); ++f) ++begin[static_cast<std::size_t>(renumbered(f).low) + 1];
    for (std::size_t v = 0; v < new_index.size(); ++v) begin[v + 1] += begin[v];
    std::vector<Face> list(static_cast<std::size_t>(faces.rows()));
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const Face face = renumbered(f);
        list[next[static_cast<std::size_t>(face.low)]++] = face;
    }
    constexpr std::size_t in_a_row = 4096;
    core::parallel_for(new_index.size(), in_a_row, [&](std::size_t v) {
        std::sort(list.begin() + static_cast<std::ptrdiff_t>(begin[v]),
                  list.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]), [](const Face& a, const Face& b) {
                      return a.second != b.second ? a.second < b.second : a.third < b.third;
                  });
    });
    Triangles out(faces.rows(), 3);
    for (std::size_t f = 0; f < list.size(); ++f)
        out.row(static_cast<Eigen::Index>(f)) << list[f].low, list[f].second, list[f].third;
    return out;
}

} // namespace detail

template <typename Scalar>
CanonicalPlaces<Scalar> canonical_places(const TriangleMesh<Scalar>& mesh) {
    // Centring first keeps precision when the body stands a hundred body lengths from the origin.
    const Eigen::Index n = mesh.vertices.rows();
    TriangleMesh<Scalar> input = mesh;
    const Vector3<Scalar> offset = detail::mean_of(mesh.vertices);
    for (Eigen::Index v = 0; v < n; ++v)
        core::set_point<Scalar>(input.vertices, v, core::point(input.vertices, v) - offset);
    const Scalar extent = input.vertices.cwiseAbs().maxCoeff();
    if (!(extent > 0)) throw Error(ErrorCode::bad_input, "the surface has no extent; all its vertices coincide");
    input.vertices /= extent;

    const detail::SurfaceMoments moments = detail::surface_moments(input);
    if (!(moments.area > core::rounding<Scalar>() * core::rounding<Scalar>()))
        throw Error(ErrorCode::bad_input, "the surface has no area; all faces are degenerate");
    const Vector3<Scalar> centroid = moments.centroid.template cast<Scalar>();
    const Scalar size = static_cast<Scalar>(std::sqrt(moments.area));

    CanonicalPlaces<Scalar> out;
    out.similarity.rotation = detail::principal_rotation(input, moments).template cast<Scalar>();
    out.similarity.scale = extent * size;
    out.similarity.origin = offset + extent * centroid;
    out.vertices = std::move(input.vertices);
    for (Eigen::Index v = 0; v < n; ++v) {
        const Vector3<Scalar> turned =
            out.similarity.rotation * Vector3<Scalar>(core::point(out.vertices, v) - centroid);
        core::set_point<Scalar>(out.vertices, v, turned / size);
    }
    return out;
}

template <typename Scalar>
CanonicalMesh<Scalar> canonical_form(const TriangleMesh<Scalar>& mesh) {
    const CanonicalPlaces<Scalar> moved = canonical_places(mesh);
    CanonicalMesh<Scalar> out;
    out.similarity = moved.similarity;
    out.input_vertex = detail::geometric_order(moved.vertices);
    std::vector<int> canonical_index(out.input_vertex.size());
    out.mesh.vertices.resize(moved.vertices.rows(), 3);
    for (std::size_t i = 0; i < out.input_vertex.size(); ++i) {
        canonical_index[static_cast<std::size_t>(out.input_vertex[i])] = static_cast<int>(i);
        core::set_point(out.mesh.vertices, static_cast<Eigen::Index>(i),
                        core::point(moved.vertices, out.input_vertex[i]));
    }
    out.mesh.faces = detail::sorted_faces(mesh.faces, canonical_index);
    return out;
}

} // namespace skelgen::surface
