#include <skelgen/applications/impl/mirror_plane.hpp>

#include <cmath>
#include <random>

#include <Eigen/Geometry>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::applications;

namespace {

/// Half an ellipsoid with a bump at either side of x = 0, its outer sides; every sample has its mirror image where
/// `is_even`, else samples lie anywhere.
template <typename Scalar>
SurfaceSamples<Scalar> two_bumps(bool is_even) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    SurfaceSamples<Scalar> out;
    constexpr int count = 800;
    out.places.resize(count, 3), out.normals.resize(count, 3);
    out.areas = Eigen::VectorX<core::Accumulator>::Ones(count);
    const auto height = [](double x, double y) {
        return -0.4 * (x * x + y * y) +
               0.3 * std::exp(-8 * ((std::abs(x) - 0.4) * (std::abs(x) - 0.4) + (y - 0.1) * (y - 0.1)));
    };
    for (int i = 0; i < count; ++i) {
        double x = uniform(random), y = uniform(random) / 2;
        if (is_even && i % 2 == 1) {
            x = -static_cast<double>(out.places(i - 1, 0));
            y = static_cast<double>(out.places(i - 1, 1));
        }
        const double step = 1e-4;
        const Vector3<double> normal = Vector3<double>((height(x - step, y) - height(x + step, y)) / (2 * step),
                                                       (height(x, y - step) - height(x, y + step)) / (2 * step), 1)
                                           .normalized();
        out.places.row(i) << Scalar(x), Scalar(y), Scalar(height(x, y));
        out.normals.row(i) = normal.transpose().cast<Scalar>();
    }
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("mirror plane: found from a guess that is off by 20 degrees", "[applications]", float, double) {
    using Scalar = TestType;
    const Vector3<Scalar> guess =
        Eigen::AngleAxis<Scalar>(Scalar(0.35), Vector3<Scalar>(0, Scalar(0.6), Scalar(0.8))) * Vector3<Scalar>::UnitX();
    const MirrorPlane<Scalar> even = mirror_plane(two_bumps<Scalar>(true), {guess, Scalar(0.1)}, Scalar(0.3));
    CHECK(even.normal.x() == Approx(1).margin(1e-4));
    CHECK(even.offset == Approx(0).margin(1e-3));
    const MirrorPlane<Scalar> uneven = mirror_plane(two_bumps<Scalar>(false), {guess, Scalar(0.1)}, Scalar(0.3));
    CHECK(uneven.normal.x() > std::cos(Scalar(0.04))); // 2 degrees
    CHECK(std::abs(uneven.offset) < Scalar(0.02));
}

TEST_CASE("mirror plane: turned with its samples", "[applications]") {
    SurfaceSamples<double> samples = two_bumps<double>(false);
    const MirrorPlane<double> plain = mirror_plane(samples, {}, 0.3);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Vector3<double>(1, 2, 2) / 3));
    const Vector3<double> shift(1, -2, 0.5);
    samples.places = (samples.places * turn.toRotationMatrix().transpose()).rowwise() + shift.transpose();
    samples.normals = samples.normals * turn.toRotationMatrix().transpose();
    const Vector3<double> side = turn * Vector3<double>::UnitX();
    const MirrorPlane<double> turned = mirror_plane(samples, {side, side.dot(shift)}, 0.3);
    CHECK((turned.normal - turn * plain.normal).norm() < 1e-6);
    const Vector3<double> place(0.3, 0.2, 0.1);
    CHECK((turned(turn * place + shift) - (turn * plain(place) + shift)).norm() < 1e-6);
}

TEST_CASE("mirror plane: few samples say nothing", "[applications]") {
    SurfaceSamples<double> samples = two_bumps<double>(false);
    samples.places.conservativeResize(29, 3), samples.normals.conservativeResize(29, 3),
        samples.areas.conservativeResize(29);
    const MirrorPlane<double> guess{Vector3<double>(0, 1, 0), 0.25};
    CHECK(mirror_plane(samples, guess, 0.3).normal == guess.normal);
    CHECK(mirror_plane(samples, guess, 0.3).offset == guess.offset);
}
