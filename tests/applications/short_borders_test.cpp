#include <skelgen/applications/impl/short_borders.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include <skelgen/applications/impl/part_shares.hpp>
#include <skelgen/applications/impl/surface_labels.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::applications;
using namespace skelgen::test;

namespace {

constexpr double walk = 0.025; // as segmentation has it, on a body of area 1

/// How long the line is between vertices of this label and others, through the middles of the edges.
double border_of(const Body<double>& body, const std::vector<int>& labels, int label) {
    double length = 0;
    for (Eigen::Index f = 0; f < body.mesh.faces.rows(); ++f) {
        std::vector<Vector3<double>> crossed;
        for (int k = 0; k < 3; ++k) {
            const int a = body.mesh.faces(f, k), b = body.mesh.faces(f, (k + 1) % 3);
            if ((labels[static_cast<std::size_t>(a)] == label) != (labels[static_cast<std::size_t>(b)] == label))
                crossed.emplace_back((core::point(body.mesh.vertices, a) + core::point(body.mesh.vertices, b)) / 2);
        }
        if (crossed.size() == 2) length += (crossed[0] - crossed[1]).norm();
    }
    return length;
}

/// A label for each vertex by its place in the input's coordinates.
template <typename Label>
std::vector<int> labelled(const Body<double>& body, const Label& label_at) {
    std::vector<int> labels;
    for (Eigen::Index v = 0; v < body.mesh.vertices.rows(); ++v)
        labels.push_back(label_at(body.similarity.to_input(core::point(body.mesh.vertices, v))));
    return labels;
}

} // namespace

TEST_CASE("a border frayed at random becomes the ring of a cylinder", "[applications]") {
    const double radius = 0.1;
    const Body<double> body = surface::prepare(cylinder(radius, 1.5, 48, 120));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> frayed(-0.02, 0.02);
    const std::vector<int> labels =
        labelled(body, [&](const Vector3<double>& place) { return place.z() > 0.7 + frayed(random) ? 1 : 0; });
    const double ring = 2 * pi * radius / body.similarity.scale;
    const std::vector<int> found = smoothed_labels(body, labels, {0, 1}, walk);
    CHECK(border_of(body, labels, 1) > 1.5 * ring);
    CHECK(border_of(body, found, 1) < 1.01 * ring);
    const auto changed = std::inner_product(found.begin(), found.end(), labels.begin(), 0, std::plus<>(),
                                            [](int a, int b) { return a == b ? 0 : 1; });
    CHECK(changed < 8 * 48); // within a few rings
}

TEST_CASE("a border beside a waist goes to the waist, one far from it stays", "[applications]") {
    std::vector<std::array<double, 2>> profile{{0, -0.75}};
    for (int i = 0; i <= 150; ++i) {
        const double z = -0.75 + 0.01 * i;
        profile.push_back({0.1 - 0.05 * std::exp(-z * z / (2 * 0.03 * 0.03)), z});
    }
    profile.push_back({0, 0.75});
    const Body<double> body = surface::prepare(surface_of_revolution(profile, 40));
    const auto height_of = [&](double divided_at) {
        const std::vector<int> labels =
            labelled(body, [&](const Vector3<double>& place) { return place.z() > divided_at ? 1 : 0; });
        const std::vector<int> found = smoothed_labels(body, labels, {0, 1}, walk);
        double lowest = 1;
        for (std::size_t v = 0; v < found.size(); ++v)
            if (found[v] == 1)
                lowest = std::min(
                    lowest,
                    body.similarity.to_input(core::point(body.mesh.vertices, static_cast<Eigen::Index>(v))).z());
        return lowest;
    };
    CHECK(height_of(0.015) == Approx(0).margin(0.0101));
    CHECK(height_of(0.405) == Approx(0.405).margin(0.0101));
}

TEST_CASE("a narrow label keeps its core, however much shorter borders were without it", "[applications]") {
    const Body<double> body = surface::prepare(cylinder(0.1, 1.5, 48, 120));
    const std::vector<int> labels = labelled(body, [](const Vector3<double>& place) {
        return place.z() < 0.7 ? 0 : place.z() < 0.74 && std::abs(place.x()) < 0.08 ? 1 : 2;
    });
    const std::vector<int> found = smoothed_labels(body, labels, {0, 1, 2}, walk);
    for (int label = 0; label < 3; ++label) CHECK(std::count(found.begin(), found.end(), label) > 0);
}

TEST_CASE("what is nearer to a label's mirror image does not go to it", "[applications]") {
    const Body<double> body = surface::prepare(box({0.12, 0.5, 1.2}, 6));
    const std::vector<int> labels = labelled(body, [](const Vector3<double>& place) {
        if (place.z() > 0.6 - 0.5 * std::abs(place.x() - 0.06)) return 0; // a trunk, whose middle reaches down
        return place.x() > 0.06 ? 1 : 2;
    });
    const std::vector<int> found = smoothed_labels(body, labels, {0, 2, 1}, walk);
    int exchanged = 0;
    for (std::size_t v = 0; v < found.size(); ++v) {
        const double x =
            body.similarity.to_input(core::point(body.mesh.vertices, static_cast<Eigen::Index>(v))).x() - 0.06;
        if ((found[v] == 1 && x < -0.01) || (found[v] == 2 && x > 0.01)) ++exchanged;
    }
    CHECK(exchanged == 0);
    CHECK(border_of(body, found, 0) <= border_of(body, labels, 0));
}
