#pragma once

// A forearm and a hand of tubes, whose joints are known: a left one in the T-pose, its palm down, of length 1.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/hands/digit.hpp>

#include "shapes.hpp"

namespace skelgen::test {

/// A digit as a tube along its joints, to the end of its last bone.
struct TubeDigit {
    std::vector<Vec3> places; ///< knuckle, joints, end
    double radius = 0.045;

    [[nodiscard]] Vec3 tip() const {
        const Vec3 last = places.back() - places[places.size() - 2];
        return places.back() + radius * last.normalized();
    }
};

/// A finger from its knuckle on, fanned out by `spread` radians, with its two further joints bent by `curl`.
inline TubeDigit finger(double across, double length, double spread, double curl = 0) {
    const std::array<double, 3> parts{0.42, 0.31, 0.27};
    TubeDigit out{{Vec3(0.5, 0, across)}};
    double bend = 0;
    for (const double part : parts) {
        const Vec3 direction(std::cos(bend) * std::cos(spread), -std::sin(bend), std::cos(bend) * std::sin(spread));
        out.places.push_back(out.places.back() + part * length * direction);
        bend += curl;
    }
    return out;
}

inline TubeDigit thumb() {
    return {{Vec3(0.12, 0, 0.1), Vec3(0.27, 0, 0.27), Vec3(0.36, 0, 0.35), Vec3(0.42, 0, 0.4)}, 0.055};
}

/// Index to little, as long as people's.
inline std::vector<TubeDigit> four_fingers(double curl = 0) {
    return {finger(0.17, 0.42, 0.15, curl), finger(0.06, 0.46, 0.05, curl), finger(-0.05, 0.43, -0.05, curl),
            finger(-0.16, 0.34, -0.15, curl)};
}

/// The surface around forearm, palm and digits; `more` tubes of radius 0.06 beside them.
inline Mesh hand_of(const std::vector<TubeDigit>& digits, const std::vector<std::array<Vec3, 2>>& more = {}) {
    struct Tube {
        Vec3 a, b;
        double radius;
    };
    std::vector<Tube> tubes{{Vec3(-0.7, 0, 0), Vec3::Zero(), 0.15}};
    for (const double across : {0.15, 0.05, -0.05, -0.15})
        tubes.push_back({Vec3(0, 0, across / 3), Vec3(0.48, 0, across), 0.09});
    for (const TubeDigit& digit : digits)
        for (std::size_t i = 1; i < digit.places.size(); ++i)
            tubes.push_back({digit.places[i - 1], digit.places[i], digit.radius});
    for (const auto& [a, b] : more) tubes.push_back({a, b, 0.06});
    const auto field = [&](const Vec3& p) {
        double least = 1;
        for (const Tube& tube : tubes) least = std::min(least, segment_distance(p, tube.a, tube.b) - tube.radius);
        return least;
    };
    Vec3 low(-0.9, -0.5, -0.45), high(1.15, 0.25, 0.55);
    for (const auto& ends : more)
        for (const Vec3& end : ends) {
            low = low.cwiseMin(end - Vec3::Constant(0.1));
            high = high.cwiseMax(end + Vec3::Constant(0.1));
        }
    return level_set(field, low, high, 0.02);
}

/// What a skeleton says of such a hand.
template <typename Scalar = double>
KinematicSkeleton<Scalar> arm_skeleton(Side side = Side::left) {
    KinematicSkeleton<Scalar> out;
    out.template_name = "human21";
    const auto sign = static_cast<Scalar>(sign_of(side));
    const std::string prefix(side_prefix(side));
    int parent = -1;
    for (const auto& [name, x] : {std::pair{"elbow", -1.2}, std::pair{"wrist", 0.0}, std::pair{"hand", 0.5}}) {
        out.joints.push_back({prefix + name, parent, sign * static_cast<Scalar>(x) * Vector3<Scalar>::UnitX()});
        parent = static_cast<int>(out.joints.size()) - 1;
    }
    out.end_points.emplace_back(prefix + "fingertip", sign * Vector3<Scalar>::UnitX());
    return out;
}

/// The other side's hand.
inline Mesh mirrored(Mesh mesh) {
    mesh.vertices.col(0) *= -1;
    mesh.faces.col(1).swap(mesh.faces.col(2));
    return mesh;
}

} // namespace skelgen::test
