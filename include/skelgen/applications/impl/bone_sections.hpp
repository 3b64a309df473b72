#pragma once

#include <skelgen/applications/bone_sections.hpp>

#include <cstddef>
#include <utility>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/surface/contours.hpp>

namespace skelgen::applications {

template <typename Scalar>
std::vector<BoneSection<Scalar>> bone_sections(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                                               const SkeletonTemplate& skeleton_template, int per_bone) {
    core::require_in_range("bone_sections.per_bone", per_bone, 1, 100);
    constexpr Scalar reach = Scalar(0.02); // of a bone that has come out of a thin limb, on a body of unit area
    const KinematicSkeleton<Scalar> inside = surface::to_body(body, skeleton);
    std::vector<BoneSection<Scalar>> sections;
    for (std::size_t j = 0; j < inside.joints.size(); ++j) {
        const Vector3<Scalar> from = inside.joints[j].position;
        const Vector3<Scalar> bone = bone_end(inside, skeleton_template, static_cast<int>(j)) - from;
        const Vector3<Scalar> direction = bone.stableNormalized();
        if (direction.isZero()) continue;
        for (int i = 0; i < per_bone; ++i) {
            const Vector3<Scalar> place = from + (Scalar(i) + Scalar(0.5)) / Scalar(per_bone) * bone;
            auto contour = surface::contour_around(body.mesh, body.adjacency, body.tree, place, direction, reach);
            if (!contour) continue;
            for (Vector3<Scalar>& point : contour->points) point = body.similarity.to_input(point);
            sections.push_back({static_cast<int>(j), std::move(contour->points)});
        }
    }
    return sections;
}

} // namespace skelgen::applications
