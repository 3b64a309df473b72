#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <nanoflann.hpp>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::applications {

/// A piece of surface by samples of it.
template <typename Scalar = double>
struct SurfaceSamples {
    Points<Scalar> places;                   ///< n x 3
    Points<Scalar> normals;                  ///< n x 3, of length 1
    Eigen::VectorX<core::Accumulator> areas; ///< n, what each stands for
};

/// A plane by its normal, of length 1, and how far along that it lies.
template <typename Scalar = double>
struct MirrorPlane {
    Vector3<Scalar> normal = Vector3<Scalar>::UnitX();
    Scalar offset = 0;

    [[nodiscard]] Vector3<Scalar> operator()(const Vector3<Scalar>& place) const {
        return place - 2 * (normal.dot(place) - offset) * normal;
    }
};

namespace detail {

/// The samples' places beside their normals, each as long as it is worth.
template <typename Scalar>
using Looks = Eigen::Matrix<Scalar, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// A sample, the one that its mirror image is nearest to, and how near.
template <typename Scalar>
struct MirrorPair {
    Eigen::Index sample = 0, image = 0;
    Scalar squared = 0;
};

/// Every sample (but of very many an even choice) with that which its mirror image is nearest to, the nearest first.
template <typename Scalar, typename Tree>
std::vector<MirrorPair<Scalar>> mirror_pairs(const SurfaceSamples<Scalar>& samples, const MirrorPlane<Scalar>& plane,
                                             Scalar look, const Tree& tree) {
    constexpr Eigen::Index enough = 600; // for three numbers, many times over
    const Eigen::Index step = std::max<Eigen::Index>(1, samples.places.rows() / enough);
    std::vector<MirrorPair<Scalar>> pairs;
    for (Eigen::Index i = 0; i < samples.places.rows(); i += step) {
        const Vector3<Scalar> place = plane(core::point(samples.places, i)), normal = core::point(samples.normals, i);
        Eigen::Matrix<Scalar, 6, 1> image;
        image << place, look * (normal - 2 * normal.dot(plane.normal) * plane.normal);
        MirrorPair<Scalar> pair{i, 0, 0};
        nanoflann::KNNResultSet<Scalar, Eigen::Index> result(1);
        result.init(&pair.image, &pair.squared);
        tree.index->findNeighbors(result, image.data(), nanoflann::SearchParams());
        pairs.push_back(pair);
    }
    std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
        return std::pair(a.squared, a.sample) < std::pair(b.squared, b.sample);
    });
    return pairs;
}

/// The plane that lies best between pairs: of all mirror images of the samples those of it are nearest to their
/// partners.
template <typename Scalar>
MirrorPlane<Scalar> plane_between(const SurfaceSamples<Scalar>& samples, const std::vector<MirrorPair<Scalar>>& pairs,
                                  const Vector3<Scalar>& side) {
    using Vector = Vector3<core::Accumulator>;
    core::Accumulator all = 0;
    Vector middle = Vector::Zero(), image_middle = Vector::Zero();
    const auto place = [&](Eigen::Index i) -> Vector {
        return core::point(samples.places, i).template cast<core::Accumulator>();
    };
    for (const auto& pair : pairs) {
        const core::Accumulator area = samples.areas[pair.sample];
        all += area;
        middle += area * place(pair.sample);
        image_middle += area * place(pair.image);
    }
    middle /= all, image_middle /= all;
    Eigen::Matrix<core::Accumulator, 3, 3> moments = Eigen::Matrix<core::Accumulator, 3, 3>::Zero();
    for (const auto& pair : pairs)
        moments +=
            samples.areas[pair.sample] * (place(pair.sample) - middle) * (place(pair.image) - image_middle).transpose();
    // Mirroring with I - 2 n n' keeps trace(M) - 2 n' M n of the moments M in common: most where n' M n is the least.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<core::Accumulator, 3, 3>> axes(moments + moments.transpose());
    Vector normal = axes.eigenvectors().col(0);
    if (normal.dot(side.template cast<core::Accumulator>()) < 0) normal = -normal;
    return {normal.template cast<Scalar>(), static_cast<Scalar>(normal.dot(middle + image_middle) / 2)};
}

} // namespace detail

/// The plane in which a piece of surface is most nearly its own mirror image, looked for from `guess` on: samples are
/// mirrored and matched with the nearest ones that look the same way, the plane is laid anew between them by least
/// squares, and so on (BM92); the fifth that matches worst does not count. `look`: the distance that normals at right
/// angles are worth; larger than 0. Fewer than 30 samples say nothing: the guess comes back. O(n log n) a round, at
/// most 40.
template <typename Scalar>
MirrorPlane<Scalar> mirror_plane(const SurfaceSamples<Scalar>& samples, const MirrorPlane<Scalar>& guess, Scalar look) {
    constexpr Eigen::Index fewest = 30;
    constexpr int rounds = 40;
    const Scalar still = Scalar(1e-4); // radians
    if (samples.places.rows() < fewest) return guess;
    detail::Looks<Scalar> looks(samples.places.rows(), 6);
    looks << samples.places, look * samples.normals;
    const nanoflann::KDTreeEigenMatrixAdaptor<detail::Looks<Scalar>, 6, nanoflann::metric_L2_Simple> tree(6, looks);
    MirrorPlane<Scalar> plane = guess;
    for (int round = 0; round < rounds; ++round) {
        auto pairs = detail::mirror_pairs(samples, plane, look, tree);
        pairs.resize(pairs.size() * 4 / 5);
        const MirrorPlane<Scalar> next = detail::plane_between(samples, pairs, plane.normal);
        const bool is_still = next.normal.cross(plane.normal).norm() < still;
        plane = next;
        if (is_still) break;
    }
    return plane;
}

} // namespace skelgen::applications
