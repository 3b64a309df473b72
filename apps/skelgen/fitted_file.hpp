#pragma once

#include <filesystem>

#include <skelgen/extract.hpp>
#include <skelgen/io/skeleton_json.hpp>

#include "mesh_input.hpp"

namespace skelgen::cli {

/// A mesh, the skeleton that was found in it, and the surface that it was found in.
struct FittedFile {
    TriangleMesh<double> mesh;
    FittedBody<double> found;
    io::SourceMesh source;

    [[nodiscard]] const KinematicSkeleton<double>& skeleton() const { return found.extraction.skeleton; }
};

/// Reads a mesh and finds the body in it, without its curve. \throws Error as `io::read_mesh` and `extract_body`,
/// without the file's name.
[[nodiscard]] FittedFile fit_file(const MeshInput& input, ExtractOptions options = {});

/// Prints what is to be known of a skeleton that was found in a file, and that it is a guess where it is one.
void print_warnings(const std::filesystem::path& file, const KinematicSkeleton<double>& skeleton);

} // namespace skelgen::cli
