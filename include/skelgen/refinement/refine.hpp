#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/refinement/centreline.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/head.hpp>
#include <skelgen/refinement/thickness_profile.hpp>
#include <skelgen/refinement/trunk_shape.hpp>

namespace skelgen {

/// Constants of the refinement (LF20 section 3.2); lengths relative to the bones they apply to.
struct RefinementOptions {
    CentrelineOptions centreline;
    ThicknessProfileOptions thickness_profile;
    HeadOptions head;
    double flatness = 0.1; ///< a section counts as cylindrical below this flatness of its Gauss map (LF20)
    double bend_from = 25; ///< degrees; below, an elbow or knee is straight and placed by length ratio
    double bend_full = 45; ///< degrees; above, it is placed by its bones' lines; between, blended
    double bend_weight =
        0.7; ///< from the centreline to where the lines meet; calibrated on registered and landmarked bodies
    double larger_head = 1.2; ///< in adult heads: a head from this size on is a child's
    double neck_below_throat =
        0.07; ///< of the distance from neck to top of the head; calibrated, between registered and landmarked bodies
    double throat_weight = 0.6; ///< of the throat against the place by ratio
    double girdle_tolerance =
        0.4; ///< of the rest-pose distance between shoulder and neck: how far a shoulder may be off
    double waist_lowering = 0.05; ///< per radian of hip flexion, of the distance from hips to neck: the pelvis tilts
                                  ///< with the thighs; calibrated
    double crotch_depth = 0.75;   ///< in mean thigh thicknesses: a root nearer to the surface is raised (LF20: 1)
    double wrist_window = 0.03;   ///< of the forearm: how far from its place the thinnest section is looked for
};

/// Joints in template order, and the limbs' ends on the surface. Left and right are still those of the embedding.
struct RefinedJoints {
    Points<double> positions;                          ///< per template joint
    std::vector<std::pair<int, Vector3<double>>> tips; ///< end joint and the end of its limb
    std::optional<HeadShape> head;                     ///< none when the template has no neck, or the head is round
    std::optional<TrunkShape> trunk;                   ///< none when the template has no two hips or no neck
};

/// Places all joints of an embedded template by cross-sections of the original mesh and prior knowledge.
[[nodiscard]] RefinedJoints refine(const TriangleMesh<double>& mesh, const std::vector<EndPoint>& ends,
                                   const CurveSkeleton<double>& curve, const Embedding& embedding,
                                   const SkeletonTemplate& skeleton_template, const RefinementOptions& options = {});

} // namespace skelgen
