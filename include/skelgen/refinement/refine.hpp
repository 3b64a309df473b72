#pragma once

#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/refinement/centreline.hpp>
#include <skelgen/refinement/end_points.hpp>

namespace skelgen {

/// Constants of the refinement (LF20 section 3.2); lengths relative to the bones they apply to.
struct RefinementOptions {
    CentrelineOptions centreline;
    double flatness = 0.1;        ///< a section counts as cylindrical below this flatness of its Gauss map (LF20)
    double bend_from = 25;        ///< degrees; below, an elbow or knee is straight and placed by length ratio
    double bend_full = 45;        ///< degrees; above, it is placed where its bones' lines meet; between, blended
    double girdle_tolerance = 0.4; ///< of the rest-pose distance between shoulder and neck: how far a shoulder may be off
    double crotch_depth = 0.75;   ///< in mean thigh thicknesses: a root nearer to the surface is raised (LF20: 1)
    double wrist_window = 0.03;   ///< of the forearm: how far from its place the thinnest section is looked for
};

/// Joints in template order with their thickness, and the limbs' ends on the surface.
struct RefinedJoints {
    Points<double> positions;                       ///< per template joint
    Eigen::VectorXd radii;                          ///< mean distance from the joint to the surface around it
    std::vector<std::pair<int, Vector3<double>>> tips; ///< end joint and the end of its limb
    std::vector<std::string> warnings;
};

/// Places all joints of an embedded template by cross-sections of the original mesh and prior knowledge. Left and right
/// are still those of the embedding.
[[nodiscard]] RefinedJoints refine(const TriangleMesh<double>& mesh, const std::vector<EndPoint>& ends,
                                   const CurveSkeleton<double>& curve, const Embedding& embedding,
                                   const SkeletonTemplate& skeleton_template, const RefinementOptions& options = {});

} // namespace skelgen
