#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/synth/garment.hpp>
#include <skelgen/synth/hand_shape.hpp>
#include <skelgen/synth/pieces.hpp>
#include <skelgen/synth/pose.hpp>
#include <skelgen/synth/scan_faults.hpp>
#include <skelgen/synth/shape.hpp>

namespace skelgen::synth {

/// What is known about a synthetic body by construction, in the coordinates of its mesh.
struct BodyTruth {
    std::array<Vector3<double>, body_joint_count> joints;            ///< in the order of BodyJoint
    std::vector<std::pair<std::string, Vector3<double>>> end_points; ///< head_top, left_fingertip, ... on vertices
    std::vector<BodyJoint> missing; ///< not in the mesh; `joints` says where they would be
    std::vector<DigitTruth> digits; ///< of the hands that are not missing: the left one's first, from the thumb on
    double geodesic_diameter = 0;   ///< largest distance on the mesh along its edges
};

/// A mesh of a posed human body and the skeleton in it. Metres; z up, the sole of the lowest foot at 0; in the rest
/// orientation x points to the person's left and y backwards.
struct SynthBody {
    TriangleMesh<double> mesh;
    BodyTruth truth;
};

inline constexpr int least_faces = 5000;
inline constexpr int most_faces = 3000000;

/// A body that is dressed or less than perfect.
struct BodyPlan {
    std::string name; ///< of its files
    BodyShape shape;
    BodyPose pose;
    int faces = 13776;
    bool may_touch = false;         ///< parts that touch grow together: handles, genus above 0
    std::vector<BodyJoint> missing; ///< wrists, elbows, shoulders, ankles, knees from which on a limb is left out
    std::vector<Garment> clothes;   ///< put on in this order; the joints stay those of the body
    std::array<HandShape, 2> hands; ///< the left one and the right one
    BodyPieces pieces;
    ScanFaults faults;
};

/// As planned; watertight and manifold but for the pieces and the faults.
/// \throws Error usage as `synthesize_body`.
[[nodiscard]] SynthBody synthesize_body(const BodyPlan& plan);

/// A watertight, manifold mesh of genus 0 with `faces` triangles, `least_faces` to `most_faces`: exactly so many below
/// 60 thousand where that is an even number, within 0.1 % above. The same arguments give the same bytes. Seconds for
/// 14K faces, a minute for 3M. \throws Error usage when an argument is out of its range, or limbs sink into each other
/// or touch in this pose.
[[nodiscard]] SynthBody synthesize_body(const BodyShape& shape, const BodyPose& pose, int faces);

/// The smallest gap in metres between parts of the body that are no neighbours, negative where they sink into each
/// other; an estimate, good to some millimetres.
[[nodiscard]] double limb_clearance(const BodyShape& shape, const BodyPose& pose);

/// The same of a planned body, with its hands; clothes and what is missing do not count.
[[nodiscard]] double limb_clearance(const BodyPlan& plan);

/// The pose with arms and legs spread until nothing touches: what a heavier body makes of a pose.
/// \throws Error usage when spreading does not help.
[[nodiscard]] BodyPose spread_limbs(const BodyShape& shape, const BodyPose& pose);

/// The first of the random poses from `seed` on in which no limbs touch.
[[nodiscard]] BodyPose random_free_pose(const BodyShape& shape, std::uint64_t seed);

/// JSON with the fields of the reference data: mesh, scale (the geodesic diameter), source, joints, markers, end_points
/// and, where there are any, the missing joints. Digits have their joints in `fingers`, named as in `human51`, and
/// their tips among the end points. `fused` has the digits that are one with another, by the first joint of that one.
/// \param mesh_file what to write into "mesh"
[[nodiscard]] std::string truth_to_json(const BodyTruth& truth, const std::string& mesh_file);

} // namespace skelgen::synth
