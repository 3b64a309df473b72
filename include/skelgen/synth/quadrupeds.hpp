#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/synth/tubes.hpp>

namespace skelgen::synth {

/// A four-legged animal of tubes. Metres; z up, the lowest toe at 0, facing -y: x points to its left.
struct QuadrupedPlan {
    TubePlan body;                                                   ///< named by its kind and how it holds itself
    std::vector<std::pair<std::string, Vector3<double>>> joints;     ///< of the template `quadruped`; those it has
    std::vector<std::pair<std::string, Vector3<double>>> end_points; ///< head_tip, left_fore_toe, ..., tail_tip
};

/// Animals from dachshund to giraffe, no two with the same proportions, with tails of all lengths or none, with ears
/// or horns: standing, walking, galloping, sitting, lying on the belly or on a side, grazing, looking around. Nothing
/// touches. The same seed gives the same plans, fewer of them the first ones.
/// \throws Error internal when no free pose is found.
[[nodiscard]] std::vector<QuadrupedPlan> quadruped_plans(std::uint64_t seed, std::size_t count = 40);

/// A closed mesh of genus 0: `synthesize_tube` of the plan's body. \throws Error usage as that.
[[nodiscard]] TriangleMesh<double> synthesize_quadruped(const QuadrupedPlan& plan, int faces);

/// JSON with the fields of the reference data: expect, mesh, scale (the mesh's largest extent), source, joints, markers
/// (feet, head, nose, tail's tip, knees and elbows) and end_points.
/// \param mesh_file what to write into "mesh"
[[nodiscard]] std::string quadruped_truth_to_json(const QuadrupedPlan& plan, const TriangleMesh<double>& mesh,
                                                  const std::string& mesh_file);

} // namespace skelgen::synth
