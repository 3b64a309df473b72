#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <skelgen/applications/correspondence.hpp>
#include <skelgen/applications/measurement.hpp>
#include <skelgen/applications/segmentation.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

#include "mesh_changes.hpp"

namespace skelgen::repeatability {

/// One body of a set, and what is said of it.
struct RegisteredBody {
    std::string name;
    TriangleMesh<double> mesh;
    KinematicSkeleton<double> skeleton;
    double geodesic_diameter = 0;
    applications::Segmentation bones, body; ///< parts of the input's vertices and faces
    applications::Measurements measures;
    Body<double> surface;
    applications::ComparableBody<double> comparable; ///< of `surface`
    std::vector<int> stands_for;                     ///< per vertex of the mesh that of `surface`
};

/// How meshes are moved before anything is said of them.
[[nodiscard]] test::Motion motion_of(unsigned seed);

/// What is said of a mesh, turned at random by `seed`.
[[nodiscard]] RegisteredBody body_of(std::string name, const TriangleMesh<double>& mesh, unsigned seed);

/// Bodies that share their vertices: a vertex of one is at the same place of the person on all others.
struct RegisteredSet {
    std::string name;
    std::vector<RegisteredBody> bodies;
    std::vector<std::string> failures; ///< what was no body, and why
};

/// The sets in the folders of `meshes` whose meshes have equally many vertices, of each every `every`th mesh, in the
/// order of their names. Each body is turned at random before anything is said of it; what is said is brought back.
[[nodiscard]] std::vector<RegisteredSet> load_sets(const std::filesystem::path& meshes, std::size_t every);

} // namespace skelgen::repeatability
