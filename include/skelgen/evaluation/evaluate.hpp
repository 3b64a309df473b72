#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/io/truth_json.hpp>

namespace skelgen::evaluation {

/// Positions of joints and of the limbs' ends by name, as far as a skeleton file has them.
using JointPositions = std::map<std::string, Vector3<double>>;

/// Confidences by joint name, 0 to 1, as far as a skeleton file has them.
using JointConfidences = std::map<std::string, double>;

/// How well one skeleton agrees with the truth. Of what is no body, `refused` alone says something.
struct MeshScore {
    std::string name;
    BodyKind plan = BodyKind::human; ///< the truth's
    bool complete = false; ///< all joints are there and finite (a tail's need not); what follows is empty otherwise
    bool limbs = false;    ///< head, hands and feet, an animal's tail: each is nearest to its own marker, within 0.12
    bool sides = false;    ///< hands, feet, elbows, knees, shoulders: each nearer to its own side's marker
    std::vector<std::string> wrong_limbs;               ///< the joints that break `limbs`
    std::vector<std::string> flipped;                   ///< the joints that break `sides`
    std::optional<std::vector<std::string>> outside;    ///< the joints outside of the mesh, if a mesh was looked at
    std::vector<std::pair<std::string, double>> errors; ///< distance to the truth over its scale, in the truth's order
    std::vector<std::pair<std::string, double>> digits; ///< the same of fingers and toes that both have

    JointConfidences confidences; ///< that the skeleton's file gives its joints

    bool not_a_body = false; ///< the truth says that there is no skeleton
    bool refused = false;    ///< and there is no skeleton file, as there should be

    [[nodiscard]] bool solved() const { return not_a_body ? refused : complete && limbs && sides; }
};

/// The scores of the meshes of one data set, in the order of their names.
struct SetScore {
    std::string name;
    std::vector<MeshScore> meshes;
};

/// What a number of errors amounts to.
struct ErrorStatistics {
    std::size_t count = 0;
    double mean = 0;
    double median = 0;
    double p95 = 0; ///< 95th percentile
    double worst = 0;
    std::string worst_mesh; ///< where the worst one is
};

/// One data set's results. Errors are those of solved meshes alone: distances to a wrong limb measure nothing.
struct SetSummary {
    std::string name;
    std::size_t meshes = 0, complete = 0, limbs = 0, sides = 0, solved = 0;
    std::size_t not_bodies = 0, refused = 0; ///< meshes of no body; those of them without a skeleton, all solved
    std::optional<ErrorStatistics> errors;   ///< over all joints; none if nothing is solved
    std::vector<std::pair<std::string, ErrorStatistics>> per_joint; ///< ordered by the joints' names
    std::optional<ErrorStatistics> digits; ///< over all joints of fingers and toes, which count nowhere else
    std::vector<std::pair<std::string, ErrorStatistics>> per_digit; ///< of each, ordered likewise
    std::optional<double> inside; ///< mean share of joints inside their mesh; none if no mesh was looked at
};

/// Names of the joints of `human21` or `quadruped`, in template order.
[[nodiscard]] const std::vector<std::string>& evaluated_joints(BodyKind plan = BodyKind::human);

/// Reads the joints and end points of a skeleton file and nothing else of it: a result that breaks the file format
/// elsewhere is still to be scored. Empty when there is no such file, or nothing to score in it.
[[nodiscard]] JointPositions read_joint_positions(const std::filesystem::path& path);

/// Reads the confidences of a skeleton file's joints. Empty when there is no such file, or none in it.
[[nodiscard]] JointConfidences read_joint_confidences(const std::filesystem::path& path);

/// Scores one skeleton. An animal's tail counts where the truth marks it, and its sides where it marks both. Fingers
/// and toes need not be found: those that are, and are known, have errors of their own. O(1).
/// \throws Error bad_input when `truth` is of no body or lacks a marker, or names a joint that a complete `joints` does
/// not have, unless that is a tail's.
[[nodiscard]] MeshScore score_joints(const io::GroundTruth& truth, const JointPositions& joints);

/// The joints, of the plan's, at which the mesh's winding number is below one half. O(joints * faces).
[[nodiscard]] std::vector<std::string> joints_outside(const TriangleMesh<double>& mesh, const JointPositions& joints,
                                                      BodyKind plan = BodyKind::human);

/// Scores one skeleton file against one truth file; `mesh` (optional) is the mesh's file. Where the truth is of no
/// body, the skeleton file should not exist, and what is in it does not matter. \throws Error bad_input as
/// `read_ground_truth`, `score_joints` and `read_mesh`, with the file's name in front.
[[nodiscard]] MeshScore evaluate_file(const std::filesystem::path& truth, const std::filesystem::path& prediction,
                                      const std::optional<std::filesystem::path>& mesh = {});

/// Scores `PREDICTION/<set>/<name>.json` against every `TRUTH/<set>/<name>.json`; a body's missing one is not complete.
/// A truth folder without folders in it is one set. `meshes` (optional) holds `<set>/<name>` with a mesh's extension.
/// \throws Error bad_input as `evaluate_file`, and when there is no truth at all.
[[nodiscard]] std::vector<SetScore> evaluate_folders(const std::filesystem::path& truth,
                                                     const std::filesystem::path& prediction,
                                                     const std::optional<std::filesystem::path>& meshes = {});

/// Sums up one set's scores. O(n log n) in the number of errors.
[[nodiscard]] SetSummary summarise(const SetScore& set);

} // namespace skelgen::evaluation

namespace skelgen {
using evaluation::evaluate_file;
using evaluation::evaluate_folders;
} // namespace skelgen
