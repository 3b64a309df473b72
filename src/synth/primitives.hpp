#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/mesh.hpp>

/// Signed fields, negative inside, that are close to a distance near their surface: what bodies are put together from.
namespace skelgen::synth {

using Vec3 = Vector3<double>;
using Mat3 = Eigen::Matrix3d;

struct Ball {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
};

/// A cross-section of a tube: extents from the tube's axis, in metres.
struct Ring {
    double at;    ///< along the axis
    double side;  ///< to -x and +x
    double front; ///< to -y
    double back;  ///< to +y
};

/// A generalized cylinder around the z axis through at least two rings, closed by half an ellipsoid at either end.
class Tube {
public:
    /// `exponent` 2: elliptical sections; larger: squarer ones. `low_cap`, `high_cap`: how far the ends reach out.
    Tube(std::vector<Ring> rings, double exponent, double low_cap, double high_cap);

    [[nodiscard]] double operator()(const Vec3& p) const;

    /// The section at `at`, interpolated monotonically between the rings (clamped to the ends).
    [[nodiscard]] Ring ring(double at) const;

    [[nodiscard]] Ball bound() const;

    /// The tube with its surface moved outwards by `distance`.
    [[nodiscard]] Tube grown(double distance) const;

private:
    std::vector<Ring> rings_;
    std::vector<Ring> slopes_; ///< d(ring)/d(at) at each ring; `at` unused
    double exponent_;
    double low_cap_;
    double high_cap_;
};

struct Ellipsoid {
    Vec3 centre = Vec3::Zero();
    Vec3 radii = Vec3::Ones();
    Mat3 axes = Mat3::Identity(); ///< columns: the directions of the radii

    [[nodiscard]] double operator()(const Vec3& p) const;
};

/// The union of the balls between two balls.
struct RoundCone {
    Vec3 from = Vec3::Zero();
    Vec3 to = Vec3::UnitZ();
    double from_radius = 1;
    double to_radius = 1;

    [[nodiscard]] double operator()(const Vec3& p) const;
};

/// All points within `radius` of a segment.
class Capsule {
public:
    Capsule(const Vec3& from, const Vec3& to, double radius)
        : from_(from), axis_(to - from), radius_(radius),
          over_length2_(axis_.squaredNorm() > 0 ? 1 / axis_.squaredNorm() : 0.0) {}

    [[nodiscard]] Capsule grown(double distance) const { return {from_, from_ + axis_, radius_ + distance}; }

    /// Distance from p to the point of the capsule that is farthest from it.
    [[nodiscard]] double farthest(const Vec3& p) const {
        return std::max((p - from_).norm(), (p - from_ - axis_).norm()) + radius_;
    }

    [[nodiscard]] double operator()(const Vec3& p) const {
        const Vec3 off = p - from_;
        const double t = std::clamp(off.dot(axis_) * over_length2_, 0.0, 1.0);
        return (off - t * axis_).norm() - radius_;
    }

private:
    Vec3 from_;
    Vec3 axis_;
    double radius_;
    double over_length2_;
};

/// Everything on the negative side of a plane: `normal`.p < offset.
struct HalfSpace {
    Vec3 normal = Vec3::UnitZ();
    double offset = 0;

    [[nodiscard]] double operator()(const Vec3& p) const { return normal.dot(p) - offset; }
};

/// The union of two fields, rounded off within `blend` (a length) of where they meet; 0: the sharp union.
[[nodiscard]] double smooth_union(double a, double b, double blend);

/// What `a` and `b` share, rounded off likewise.
[[nodiscard]] double smooth_intersection(double a, double b, double blend);

enum class Use { add, carve, keep }; ///< unite with, cut away, intersect with

struct Blob {
    std::variant<Tube, Ellipsoid, RoundCone, HalfSpace> form;
    double blend = 0;
    Use use = Use::add;
    Ball bound{}; ///< the form lies inside; set by `set_bounds`
};

/// The blob with its surface moved outwards by `distance`.
[[nodiscard]] Blob grown(const Blob& blob, double distance);

/// Fills in where each blob is, which `evaluate` needs. Unbounded forms get an infinite radius.
void set_bounds(std::vector<Blob>& blobs);

/// Blobs combined in their order; `outside` where there is none.
[[nodiscard]] double evaluate(const std::vector<Blob>& blobs, const Vec3& p, double outside);

} // namespace skelgen::synth
