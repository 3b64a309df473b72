#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include <skelgen/applications/rig.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/io/scene_looks.hpp>

#include "extract_file.hpp"
#include "mesh_input.hpp"

namespace skelgen::cli {

/// A file's body bound to its skeleton.
struct Character {
    applications::Rig<double> rig;
    KeptLooks kept;
    KinematicSkeleton<double> skeleton; ///< in the file's coordinates
};

/// What is to be made of a body: which of several, held how at rest.
struct CharacterOptions {
    int component = 0; ///< as `PrepareOptions::component`
    applications::RestPose rest = applications::RestPose::as_is;
    Fingers fingers = Fingers::off;
};

/// A body bound to its skeleton, with its fingers where they are wanted. \throws Error as `applications::make_rig`.
[[nodiscard]] applications::Rig<double> rig_of(const FittedFile& body, const SkeletonTemplate& skeleton_template,
                                               applications::RestPose rest, Fingers fingers);

/// Reads a mesh, finds the body in it and binds it; where one of several is chosen, without the others. \throws Error
/// as `fit_file`, without the file's name.
[[nodiscard]] Character make_character(const MeshInput& input, const CharacterOptions& options);

/// Prints what is to be known of a character, beside what is of its skeleton.
void print_warnings(const std::filesystem::path& file, const Character& character);

/// Adds the option --names, with `help` as what it says there: `names` is then one that `io::joint_names_named` knows.
void add_joint_names_option(CLI::App& command, std::string& names, const std::string& help);

} // namespace skelgen::cli
