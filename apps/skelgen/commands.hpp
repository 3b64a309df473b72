#pragma once

#include <CLI/CLI.hpp>

namespace skelgen::cli {

// One function per command: it adds the subcommand with its options, and the callback that does the work. Callbacks
// throw skelgen::Error, its text beginning with the file concerned, or CLI::RuntimeError with an exit status when
// everything has been said already.

/// The exit status of a command that works on many meshes where some of them failed.
inline constexpr int status_some_failed = 5;

void add_extract_command(CLI::App& app);
void add_batch_command(CLI::App& app);
void add_merge_command(CLI::App& app);
void add_evaluate_command(CLI::App& app);
void add_curve_command(CLI::App& app);
void add_convert_command(CLI::App& app);
void add_align_command(CLI::App& app);
void add_segment_command(CLI::App& app);
void add_measure_command(CLI::App& app);
void add_correspond_command(CLI::App& app);
void add_rig_command(CLI::App& app);
void add_pose_command(CLI::App& app);
void add_animate_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_synth_command(CLI::App& app);
void add_view_command(CLI::App& app);
void add_documentation_command(CLI::App& app);

} // namespace skelgen::cli
