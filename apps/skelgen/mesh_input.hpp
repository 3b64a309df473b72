#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include <skelgen/core/mesh.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/scene_looks.hpp>

namespace skelgen::cli {

/// The mesh that a command works on, and how it is read.
struct MeshInput {
    std::filesystem::path file;                    ///< "-": standard input
    io::ReadMeshOptions options{.isolated = true}; ///< the program reads strangers' files
    std::filesystem::path skeleton = {};           ///< file of the skeleton to take; empty: it is to be found
    bool use_rig = false;                          ///< take the joints of the file's own rig
    std::string wanted = "human21";                ///< what is looked for: a person, `quadruped` or, of both, `auto`
};

/// Adds the positional MESH, with `help` as what it says there, and the options --format, --animation and --time.
void add_mesh_input(CLI::App& command, MeshInput& input, const std::string& help);

/// What `--component all` gives.
inline constexpr int all_components = -1;

/// Adds the option --component: which of several bodies a command works on, as `PrepareOptions::component`. `all`, each
/// of them, is refused.
void add_component_option(CLI::App& command, int& component, const std::string& name = "--component",
                          const std::string& help = "Which of several bodies that stand apart; 1 is the largest");

/// The same of a command that takes `all`, too.
void add_components_option(CLI::App& command, int& component);

/// Adds the option --skeleton: the file of the skeleton that is taken instead of searching for one.
void add_skeleton_option(CLI::App& command, std::filesystem::path& skeleton);

/// Adds the option --template of commands that need the joints of a person or an animal.
void add_wanted_option(CLI::App& command, std::string& wanted);

/// Adds the options --skeleton and --use-rig, of which one may be given.
void add_skeleton_options(CLI::App& command, MeshInput& input);

/// \throws Error as `io::read_mesh`, without the file's name.
[[nodiscard]] TriangleMesh<double> load_mesh(const MeshInput& input);

/// What the mesh looks like: nothing of its own where it is no scene. \throws Error as `io::read_looks`, without the
/// file's name.
[[nodiscard]] io::SceneLooks load_looks(const MeshInput& input);

/// How a mesh looks, and what is to be said where that, or one of its pictures, cannot be read: a body is one without.
struct KeptLooks {
    io::SceneLooks looks;
    std::string warning; ///< empty: none
};

/// As `load_looks`, but bad input costs no more than the looks.
[[nodiscard]] KeptLooks keep_looks(const MeshInput& input);

/// Prints what of the looks a mesh loses that is written in a format, in one line.
void print_lost_looks(const std::filesystem::path& file, const KeptLooks& kept, io::MeshFormat format);

} // namespace skelgen::cli
