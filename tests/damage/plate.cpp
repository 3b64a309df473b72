#include "plate.hpp"

#include "limbs.hpp"

namespace skelgen::damage {
namespace {

struct Axis {
    int number = 0;
    double sign = 1;
};

Axis up_of(const KinematicSkeleton<double>& skeleton) {
    const Vec3 feet = 0.5 * (joint_position(skeleton, "left_ankle") + joint_position(skeleton, "right_ankle"));
    const Vec3 way = joint_position(skeleton, "head") - feet;
    Axis up;
    way.cwiseAbs().maxCoeff(&up.number);
    up.sign = way[up.number] < 0 ? -1 : 1;
    return up;
}

/// The box between two corners, faces outward.
Mesh box(const Vec3& low, const Vec3& high) {
    Mesh mesh;
    mesh.vertices.resize(8, 3);
    for (int i = 0; i < 8; ++i)
        mesh.vertices.row(i) << (i & 1 ? high : low)[0], (i >> 1 & 1 ? high : low)[1], (i >> 2 ? high : low)[2];
    mesh.faces.resize(12, 3);
    mesh.faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3,
        7, 5;
    return mesh;
}

} // namespace

Mesh plate_below(const Mesh& body, const KinematicSkeleton<double>& skeleton, double gap) {
    constexpr double sole = 0.05, margin = 0.1, thickness = 0.01; // in heights
    const Axis up = up_of(skeleton);
    const Eigen::VectorXd heights = up.sign * body.vertices.col(up.number);
    const double ground = heights.minCoeff(), height = heights.maxCoeff() - ground;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (Eigen::Index v = 0; v < heights.size(); ++v) {
        if (heights[v] > ground + sole * height) continue;
        low = low.cwiseMin(body.vertices.row(v).transpose());
        high = high.cwiseMax(body.vertices.row(v).transpose());
    }
    low.array() -= margin * height;
    high.array() += margin * height;
    const double top = ground - gap * height, bottom = top - thickness * height;
    low[up.number] = std::min(up.sign * top, up.sign * bottom);
    high[up.number] = std::max(up.sign * top, up.sign * bottom);
    return box(low, high);
}

} // namespace skelgen::damage
