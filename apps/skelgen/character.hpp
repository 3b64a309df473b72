#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <skelgen/applications/engine_bones.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/io/scene_looks.hpp>

#include "extract_file.hpp"
#include "mesh_input.hpp"

namespace skelgen::cli {

/// A file's body bound to its skeleton.
struct Character {
    applications::Rig<double> rig;
    KeptLooks kept;
    KinematicSkeleton<double> skeleton; ///< in the file's coordinates
    std::vector<std::string> repairs;   ///< of its surface, a phrase each
};

/// What is to be made of a body: which of several, held how at rest.
struct CharacterOptions {
    int component = 0; ///< as `PrepareOptions::component`
    applications::RigOptions rig = {applications::RestPose::as_is, applications::Place::keep};
    Fingers fingers = Fingers::off;
    bool toes = false;
};

/// A mesh bound to the skeleton that was found in it, with its fingers and toes where they are wanted. \throws Error as
/// `applications::make_rig`.
[[nodiscard]] applications::Rig<double> rig_of(const TriangleMesh<double>& mesh, const Extraction<double>& found,
                                               const SkeletonTemplate& skeleton_template,
                                               const applications::RigOptions& options, Fingers fingers,
                                               bool toes = false);

/// Reads a mesh, finds the body in it and binds it; where one of several is chosen, without the others. \throws Error
/// as `fit_file`, without the file's name.
[[nodiscard]] Character make_character(const MeshInput& input, const CharacterOptions& options);

/// Prints what is to be known of a character that is written in a format, beside what is of its skeleton. `quiet`: none
/// but what its licence forbids, and that the skeleton is a guess.
void print_warnings(const std::filesystem::path& file, const Character& character, io::RigFormat format, bool quiet);

/// "left out: 2 animations, lights": what a scene loses whose rig is written in a format; empty: nothing.
[[nodiscard]] std::string left_out_text(io::RigFormat format, const io::SceneLooks& looks);

/// Prints what a character's licence forbids, if anything: whoever writes it again is to know.
void print_forbidden(const std::filesystem::path& file, const io::SceneLooks& looks);

/// Which joints a character gets that engines know and skelgen does not find, as the command line has it.
struct BoneOptions {
    std::string bones = "plain"; ///< or "engine"
    bool twist = false;

    [[nodiscard]] applications::EngineBones wanted() const { return {bones == "engine", twist}; }
};

/// Adds the options --bones and --twist.
void add_bone_options(CLI::App& command, BoneOptions& options);

/// Which bones of digits a character gets, as the command line has it.
struct DigitOptions {
    std::string fingers = "auto"; ///< one of `fingers_by_name`
    bool toes = false;

    [[nodiscard]] Fingers wanted() const { return fingers_by_name().at(fingers); }
};

/// Adds the options --fingers and --toes.
void add_digit_options(CLI::App& command, DigitOptions& options);

/// Adds the option --names, with `help` as what it says there: `names` is then one that `io::joint_names_named` knows.
void add_joint_names_option(CLI::App& command, std::string& names, const std::string& help);

} // namespace skelgen::cli
