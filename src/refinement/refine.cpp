#include <skelgen/refinement/refine.hpp>

#include <utility>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/thickness_profile.hpp>

#include "hip_anchor.hpp"
#include "limb_joints.hpp"
#include "placement.hpp"
#include "trunk_joints.hpp"

namespace skelgen {
namespace {

using detail::Placement;

bool is_head(const Limb& limb, const SkeletonTemplate& skeleton_template) {
    return skeleton_template.joints[static_cast<std::size_t>(limb.joints.back())].role == JointRole::head;
}

std::optional<HeadShape> head_of(const Limb& limb, const Slicer& slicer, const HeadOptions& options) {
    if (limb.joints.size() < 2) return std::nullopt; // no neck
    return measure_head(slicer, limb.line.points.bottomRows<1>().transpose(), detail::on(limb, detail::arc_of(limb, 0)),
                        options);
}

/// Draws the head's limb again where the head is plainly larger than the template's: a child's. The neck lies that much
/// lower; the head's joint stays where it was, in the middle of the larger head.
void fit_head(Limb& limb, const Slicer& slicer, const EndPoint& end, const RefinementOptions& options) {
    const auto head = head_of(limb, slicer, options.head);
    if (!head || head->size < options.larger_head) return;
    for (std::size_t i = 0; i + 1 < limb.from_tip.size(); ++i) limb.from_tip[i] *= head->size;
    draw_limb(limb, slicer, end, options.centreline);
}

/// Limbs traced, and their joints where the thickness of arms and legs and the size of the head say they are. The bones
/// measured tell the body's scale better than its geodesic diameter does, which changes with the pose.
Placement find_limbs(const Slicer& slicer, const std::vector<EndPoint>& ends, const SkeletonTemplate& skeleton_template,
                     const RefinementOptions& options) {
    const double scale = template_scale(skeleton_template, geodesic_diameter(ends));
    std::vector<Limb> limbs = trace_limbs(slicer, ends, skeleton_template, scale, options.centreline);
    detail::anchor_hips(limbs, slicer.mesh(), ends, skeleton_template, scale, options.flatness);
    const double ratio = match_thickness_profiles(limbs, skeleton_template, options.thickness_profile);
    for (std::size_t i = 0; i < limbs.size(); ++i) {
        if (!is_head(limbs[i], skeleton_template)) continue;
        for (double& from_tip : limbs[i].from_tip) from_tip *= ratio;
        fit_head(limbs[i], slicer, ends[i], options);
    }
    return Placement(skeleton_template, std::move(limbs), ratio * scale);
}

std::optional<TrunkShape> trunk_of(const Placement& placement, const Slicer& slicer) {
    const std::vector<int> hips = placement.all(JointRole::hip);
    const int neck = placement.find(JointRole::neck);
    if (hips.size() != 2 || neck < 0) return std::nullopt;
    return measure_trunk(slicer, *placement.middle(JointRole::hip), placement.at(neck),
                         placement.at(hips[0]) - placement.at(hips[1]));
}

} // namespace

RefinedJoints refine(const TriangleMesh<double>& mesh, const std::vector<EndPoint>& ends,
                     const CurveSkeleton<double>& curve, const Embedding& embedding,
                     const SkeletonTemplate& skeleton_template, const RefinementOptions& options) {
    const Triangles adjacency = face_adjacency(mesh.faces);
    const Slicer slicer(mesh, adjacency);
    Placement placement = find_limbs(slicer, ends, skeleton_template, options);
    RefinedJoints out;
    for (const Limb& limb : placement.limbs()) {
        place_by_ratio(placement, limb);
        if (is_head(limb, skeleton_template)) out.head = head_of(limb, slicer, options.head);
        if (is_head(limb, skeleton_template) && out.head) place_neck(placement, limb, *out.head, options);
        place_wrist(placement, limb, options);
        place_bend(placement, limb, options);
    }
    for (const Limb& limb : placement.limbs()) place_girdle(placement, limb, options);
    narrow_hips(placement);
    const int root = embedding.node_of_joint[static_cast<std::size_t>(placement.find(JointRole::pelvis))];
    place_trunk(placement, slicer, curve.nodes.row(root).transpose(), options);
    raise_crotch(placement, mesh, options);

    out.positions = placement.positions();
    out.trunk = trunk_of(placement, slicer);
    for (const Limb& limb : placement.limbs())
        out.tips.emplace_back(limb.joints.back(), limb.line.points.bottomRows<1>().transpose());
    return out;
}

} // namespace skelgen
