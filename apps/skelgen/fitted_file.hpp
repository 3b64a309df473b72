#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

/// Has a template looked for: a built-in one, a file's, or, named `auto`, a person's or a four-legged animal's,
/// whichever is likelier. \throws Error as `load_template`.
void want_template(ExtractOptions& options, const std::string& name_or_file);

/// Reads a mesh and finds the body in it, without its curve where that is not wanted; what is looked for is the
/// input's, whatever the options have. \throws Error as `io::read_mesh` and `extract`, without the file's name.
[[nodiscard]] FittedFile fit_file(const MeshInput& input, ExtractOptions options = {}, bool with_curve = false);

/// The same of what belongs to the body that was found, and to no other body that stands apart from it. As
/// `applications::own_body`.
[[nodiscard]] FittedFile with_own_part(FittedFile file);

/// What is left of warnings about a skeleton: all in one line what has been `repaired` in its surface, or all of it.
enum class Words {
    few, ///< that it is a guess, where it is one, and nothing else
    usual,
    all, ///< a line for each repair
};

/// Prints what is to be known of a skeleton that was found in a file, and that it is a guess where it is one.
void print_warnings(const std::filesystem::path& file, const KinematicSkeleton<double>& skeleton,
                    const std::vector<std::string>& repairs = {}, Words words = Words::usual);

/// As many as a flag for few, --quiet, has it.
[[nodiscard]] constexpr Words words_of(bool is_quiet) { return is_quiet ? Words::few : Words::usual; }

} // namespace skelgen::cli
