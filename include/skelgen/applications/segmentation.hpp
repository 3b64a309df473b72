#pragma once

#include <string>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// Which parts a body is divided into.
enum class PartSet {
    bones, ///< head, neck, chest, abdomen, pelvis; on each side shoulder, upper_arm, forearm, hand, thigh, calf, foot
    body,  ///< head (with the neck), torso; on each side upper_arm, forearm, hand, thigh, calf, foot
};

struct SegmentationOptions {
    /// Over which length borders are smoothed, relative to the square root of the area, 0.001 to 0.2: 3 cm on an
    /// adult. Calibrated: borders keep their place, necks stay, and small unevenness goes.
    double smoothing = 0.025;
    /// How far a shoulder reaches from the upper arm towards the neck, relative to that distance, 0 to 1: about to
    /// where the collarbone begins to rise.
    double shoulder = 0.25;
};

/// \throws Error usage when an option is out of its range.
void validate(const SegmentationOptions& options);

/// A surface in parts.
struct Segmentation {
    std::vector<std::string> parts; ///< names, sides in front: left_upper_arm
    std::vector<int> vertex_part;   ///< n indices into `parts`
    std::vector<int> face_part;     ///< m indices: of the part that most of a face's corners belong to
};

/// The names of the parts, in the order in which they are counted.
[[nodiscard]] std::vector<std::string> part_names(PartSet set);

/// The body's parts (LF20 section 5.3): each vertex belongs to the nearest bone of those that it can belong to, so that
/// borders are where the joints' bisecting planes cut the surface; those of a limb have the vertices alone that are
/// nearest to the limb's end along the surface, so that a hand at the thigh stays a hand. The trunk is divided between
/// its joints; a shoulder is a band around the arm. Borders are then smoothed by random walks that start at these
/// labels (Gra05), and each part is in one piece. `skeleton` has the joints of human21 and is in the input's
/// coordinates. \returns the parts of the body's own vertices and faces. \throws Error usage when a joint is missing or
/// an option is out of its range. O(n log n + n^1.5).
template <typename Scalar>
[[nodiscard]] Segmentation segment(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                                   PartSet set = PartSet::bones, const SegmentationOptions& options = {});

/// The same parts on the mesh that the body was made of: what the body left out belongs to the part that it is nearest
/// to. \throws Error usage when the body was made of another mesh. O(n log n).
template <typename Scalar>
[[nodiscard]] Segmentation to_input(const Segmentation& segmentation, const Body<Scalar>& body,
                                    const TriangleMesh<Scalar>& input);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/segmentation.hpp>
#endif
