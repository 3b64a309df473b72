#pragma once

#include <string>
#include <vector>

#include <skelgen/applications/part_axes.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

struct SegmentationOptions {
    /// Over which length borders are smoothed, relative to the square root of the area, 0.001 to 0.2: 3 cm on an
    /// adult. Calibrated: borders keep their place, necks stay, and small unevenness goes.
    double smoothing = 0.025;
    /// Where an upper arm begins, as a share of it, 0 to 1, from the shoulder's joint, across a plane that leans
    /// towards the collarbone. There the deltoid muscle ends, and raising the arm moves the skin little. Calibrated on
    /// registered bodies of six people, as the next two.
    double upper_arm = 0.3;
    /// Where a shoulder begins on the way from between chest and neck to its joint, 0 to 2, 1 in the joint.
    double shoulder = 1.1;
    /// Where a thigh begins, by how far below the hip's joint relative to the distance between both, 0 to 1: at the
    /// fork of the legs.
    double thigh = 0.3;
};

/// \throws Error usage when an option is out of its range.
void validate(const SegmentationOptions& options);

/// A surface in parts.
struct Segmentation {
    std::vector<std::string> parts; ///< names, sides in front: left_upper_arm
    std::vector<int> vertex_part;   ///< n indices into `parts`
    std::vector<int> face_part;     ///< m indices: of the part that most of a face's corners belong to
};

/// The body's parts (LF20 section 5.3). Each vertex belongs to the nearest bone of those that it can belong to, so that
/// borders are where the joints' bisecting planes cut the surface. A limb's bones have the vertices alone that are
/// nearest to the limb's end along the surface, so that a hand at the thigh stays a hand. Where a knee or an elbow is
/// bent so far that its bones come near each other, they have those as far from the end as the bone is.
/// Arms begin below the shoulder, which is where the trunk ends beyond its joint; thighs where the legs fork, across
/// the direction between the thigh's and the pelvis's own. Borders are then smoothed by random walks that start at
/// these labels (Gra05) and laid where they are shortest (KT03), and each part is in one piece. Of an animal's, limbs
/// begin where its bones do. `skeleton` has the joints of human21 or quadruped and is in the input's coordinates.
/// \returns the parts of the body's own vertices and faces. \throws Error usage when a joint is missing or an option is
/// out of its range. O(n log n + n^1.5).
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
