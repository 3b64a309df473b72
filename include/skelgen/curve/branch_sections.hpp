#pragma once

#include <vector>

#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/contours.hpp>

namespace skelgen::curve {

/// What a plane across a curve shows of the surface around a point of it.
template <typename Scalar = double>
struct BranchSection {
    Vector3<Scalar> centre = Vector3<Scalar>::Zero(); ///< mean of the contour, by length
    Vector3<Scalar> normal = Vector3<Scalar>::Zero(); ///< of the plane, along the curve; unit
    Scalar thickness = 0;                             ///< mean distance of the contour from its centre
    Scalar weight = 0;     ///< how surely the contour is the branch's own: 1 all around it, 0 where there is none
    bool encloses = false; ///< whether the point lies within the contour
    surface::Contour<Scalar> contour;
};

/// Does the point lie outside the contour that was found near it?
template <typename Scalar>
[[nodiscard]] bool is_outside(const BranchSection<Scalar>& section) {
    return section.thickness > 0 && !section.encloses;
}

/// How far off its section's centre a point is, relative to the section's thickness; of one outside ten times that, so
/// that no way leads there that there is another one for.
template <typename Scalar>
[[nodiscard]] Scalar off_centre(const BranchSection<Scalar>& section, const Vector3<Scalar>& place) {
    constexpr auto outside = Scalar(10);
    if (!section.encloses || !(section.thickness > 0)) return outside;
    return (section.centre - place).norm() / section.thickness;
}

/// Sections of at least this weight are their branch's own.
template <typename Scalar>
inline constexpr Scalar sure_section = Scalar(0.5);

/// How far from the line a contour may be that does not go around it but is its branch's all the same, in spacings.
inline constexpr int reach_in_spacings = 4;

/// Points to both sides from which the tangent is taken that a section is normal to: none farther away changes it.
inline constexpr Eigen::Index section_tangent_reach = 2;

/// The section of a line across itself at one of its points, but for the first and the last one, which have no tangents
/// of their own. `reach`: how far from the line a contour may be that does not go around it. Cost as of
/// surface::contour_around.
template <typename Scalar>
[[nodiscard]] BranchSection<Scalar> section_across(const Body<Scalar>& body, const Points<Scalar>& line,
                                                   Eigen::Index point, std::type_identity_t<Scalar> reach);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/branch_sections.hpp>
#endif
