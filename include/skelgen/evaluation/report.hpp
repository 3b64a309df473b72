#pragma once

#include <string>
#include <vector>

#include <skelgen/evaluation/evaluate.hpp>

namespace skelgen::evaluation {

/// One line on one mesh: "SET/NAME: solved, mean error 0.0123", or what is wrong with it.
[[nodiscard]] std::string mesh_score_line(const std::string& set, const MeshScore& score);

/// A set's counts and, joint by joint, its errors: the table of the paper (LF20 Table 1), four digits. Ends with a new
/// line.
[[nodiscard]] std::string summary_to_text(const SetSummary& summary);

/// One row per set and joint, and one ("all") over a set's joints; full precision, header line first.
[[nodiscard]] std::string summaries_to_csv(const std::vector<SetSummary>& summaries);

/// An object with a member per set, full precision: the counts, `mean_error`, `p95_error`, `inside` (null where there
/// are none), in sets with things that are no bodies `not_bodies` and `refused`, `per_joint` (the means), `joints` (all
/// statistics), and `per_mesh` if wanted.
[[nodiscard]] std::string scores_to_json(const std::vector<SetScore>& sets, bool with_meshes = false);

} // namespace skelgen::evaluation
