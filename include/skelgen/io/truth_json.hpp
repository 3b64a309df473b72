#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::io {

/// Joints and where they are, in a file's order.
using NamedPoints = std::vector<std::pair<std::string, Vector3<double>>>;

/// What is known about the body in one mesh, in the mesh's own coordinates.
struct GroundTruth {
    BodyKind plan = BodyKind::human;                ///< what was to be found
    double scale = 1;                               ///< largest geodesic distance or extent: the unit of all errors
    NamedPoints joints;                             ///< where they are
    std::map<std::string, Vector3<double>> markers; ///< surface points that tell limbs and sides
    NamedPoints digits = {};                        ///< joints of fingers and toes, as far as they are known
    std::set<std::string> missing;                  ///< joints that the body lacks; `joints` may have their places
    bool not_a_body = false;                        ///< there is no skeleton to be found; all else is at its default
};

/// Reads `scale`, `joints`, `markers` and, where they are there, `fingers`, `toes`, `missing` and `expect` (of
/// four-legged animals "quadruped") of a truth file (JSON), or that its `not_a_body` is true. Keys it does not know are
/// ignored. \throws Error bad_input when it cannot be read or misses something.
[[nodiscard]] GroundTruth read_ground_truth(const std::filesystem::path& path);

/// Reads the joints alone: of a file that has {"joints": {name: [x, y, z], ...}} and need not be a whole truth file.
/// \throws Error bad_input when it cannot be read or has no such joints.
[[nodiscard]] NamedPoints read_true_joints(const std::filesystem::path& path);

} // namespace skelgen::io
