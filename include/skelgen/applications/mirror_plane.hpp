#pragma once

#include <Eigen/Core>

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

/// The plane in which a piece of surface is most nearly its own mirror image, looked for from `guess` on: samples are
/// mirrored and matched with the nearest ones that look the same way, the plane is laid anew between them by least
/// squares, and so on (BM92); the fifth that matches worst does not count. `look`: the distance that normals at right
/// angles are worth; larger than 0. Fewer than 30 samples say nothing: the guess comes back. O(n log n) a round, at
/// most 40.
template <typename Scalar>
[[nodiscard]] MirrorPlane<Scalar> mirror_plane(const SurfaceSamples<Scalar>& samples, const MirrorPlane<Scalar>& guess,
                                               Scalar look);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/mirror_plane.hpp>
#endif
