#pragma once

#include <filesystem>

#include <skelgen/applications/own_part.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/skeleton_json.hpp>

#include "mesh_input.hpp"

namespace skelgen::cli {

/// What was found in a file's mesh.
struct FittedFile {
    Extraction<double> found;
    io::SourceMesh source;
    applications::OwnPart part = {}; ///< of the file's mesh, what is here

    [[nodiscard]] const TriangleMesh<double>& mesh() const { return found.mesh; }
    [[nodiscard]] const KinematicSkeleton<double>& skeleton() const { return found.skeleton; }
};

/// What files say of the mesh that something was found in.
[[nodiscard]] io::SourceMesh source_of(const MeshInput& input, const Extraction<double>& found);

/// Reads a mesh and finds the body in it, without its curve. \throws Error as `io::read_mesh` and `extract`,
/// without the file's name.
[[nodiscard]] FittedFile fit_file(const MeshInput& input, ExtractOptions options = {});

/// The same of what belongs to the body that was found, and to no other body that stands apart from it. As
/// `applications::own_body`.
[[nodiscard]] FittedFile with_own_part(FittedFile file);

/// Prints what is to be known of a skeleton that was found in a file, and that it is a guess where it is one.
void print_warnings(const std::filesystem::path& file, const KinematicSkeleton<double>& skeleton);

} // namespace skelgen::cli
