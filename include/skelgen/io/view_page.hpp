#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/applications/animation.hpp>
#include <skelgen/applications/bone_sections.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/io/scene_looks.hpp>
#include <skelgen/io/skeleton_json.hpp>

namespace skelgen::io {

/// A body with all there is to show of it. All but the rig is in the input's coordinates.
struct ViewedBody {
    std::string name; ///< below the body
    applications::Rig<double> rig;
    SceneLooks looks;
    KinematicSkeleton<double> skeleton; ///< that the rig was made of; behind its joints a rig may have those of digits
    CurveSkeleton<double> curve;
    std::vector<applications::BoneSection<double>> sections;
    std::vector<applications::Animation<double>> animations; ///< of the rig
    std::optional<SourceMesh> source = {};                   ///< what the skeleton's file says of the mesh
};

/// A body as the page takes it: JSON, an object. The rig is there as a GLB file in base64 ("glb"), its joints in the
/// GLB's order with their confidence; curve, sections and the ends of bones are in the rig's coordinates, as multiples
/// of "step". "skeleton" is the skeleton's file, "to_input" leads from the rig's coordinates to its own. Linear.
/// \throws Error usage as `rig_to_glb`, or when the rig is not in the pose of the skeleton, or was made of another one.
[[nodiscard]] std::string viewed_body_to_json(const ViewedBody& body);

/// The same of what has no skeleton: its `failure` says why. The mesh may be empty where nothing could be read. Linear.
/// \throws Error usage as `format_mesh`.
[[nodiscard]] std::string refused_body_to_json(const std::string& name, const std::string& failure,
                                               const TriangleMesh<double>& mesh);

/// The page with the bodies in it, each as above. `page_template` is HTML with an empty `<script id="bodies"
/// type="application/json">`. Linear. \throws Error internal when it has no such element.
[[nodiscard]] std::string view_page(std::string_view page_template, const std::vector<std::string>& bodies);

} // namespace skelgen::io
