#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/applications/segmentation.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// A plane in which a girth was taken, in the input's coordinates.
struct GirthPlane {
    Vector3<double> place = Vector3<double>::Zero();  ///< on it, on the bone or the axis that the girth is across
    Vector3<double> normal = Vector3<double>::Zero(); ///< of length 1, along it
};

/// What is read off a body, in the input's unit, its square and its cube.
struct Measurements {
    double height = 0;   ///< of the body stood upright, see `standing_height`
    double arm_span = 0; ///< from fingertip to fingertip along the bones, as with the arms spread; of an animal 0
    double area = 0;     ///< of the surface
    double volume = 0;
    std::vector<std::pair<std::string, double>> lengths; ///< of bones, by name: left_upper_arm, ...
    /// Around the body as a tape lies: the convex hull of the section; none where no section shows it.
    std::vector<std::pair<std::string, std::optional<double>>> girths;
    std::vector<std::optional<GirthPlane>> girth_planes; ///< one for each girth that a section shows
};

/// Height of the body stood upright, in the input's unit: from the crown along the bones to the soles, by the mean of
/// both legs. How high an ankle stands above its sole is measured where the foot would stand on it: with the angle
/// between calf and foot that human21 has. Of an animal its height at the withers: from the shoulder blades along the
/// fore legs' bones to the toes. `skeleton` has the joints of human21 or quadruped, in the input's coordinates. \throws
/// Error usage when a joint is missing. O(log n).
template <typename Scalar>
[[nodiscard]] double standing_height(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton);

/// The perimeter of the convex hull of points in a plane: how long a tape around them is; `normal` is the plane's, of
/// length 1. 0 for fewer than two points. O(k log k).
template <typename Scalar>
[[nodiscard]] Scalar tape_length(const std::vector<Vector3<Scalar>>& points, const Vector3<Scalar>& normal);

/// Lengths of bones, height, arm span, area, volume, and girths at the places that ISO17 names, across the bone there.
/// These are head, neck, chest, waist and hip. On each side they are upper_arm (in its middle), elbow, forearm, wrist,
/// thigh (the most below the buttocks), mid_thigh, knee, calf and ankle. Of chest, hip, head, forearm, thigh and calf
/// it is the largest one nearby, of neck, waist, wrist and ankle the smallest. A section that runs through another part
/// (an arm beside the chest) does not count. Of an animal the girths are of chest, waist, neck and lower legs. `parts`
/// are the body's own, of the set `bones`. \throws Error usage when a joint of human21 or quadruped is missing or
/// `parts` are another body's. O(log n) for each face that is cut.
template <typename Scalar>
[[nodiscard]] Measurements measure(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                                   const Segmentation& parts);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/measurement.hpp>
#endif
