#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/limbs.hpp>

namespace skelgen::detail {

/// Sets `top_by_trunk` of the two legs: the pelvis is one bone, and its hips lie at the same height above where the
/// legs part in everybody, however the legs are held. `ends` are the limbs' in the same order; `scale`: rest-pose
/// length to body length. Leaves it unset where there are no two legs and a head, or a leg shows too little of its
/// thigh.
void anchor_hips(std::vector<Limb>& limbs, const TriangleMesh<double>& mesh, const std::vector<EndPoint>& ends,
                 const SkeletonTemplate& skeleton_template, double scale, double flatness);

} // namespace skelgen::detail
