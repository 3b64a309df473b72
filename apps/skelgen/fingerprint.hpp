#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/io/skeleton_json.hpp>

namespace skelgen::cli {

/// 16 hexadecimal digits that tell one text from another, but not from one that is made to deceive: FNV-1a, 64 bits.
[[nodiscard]] std::string fingerprint(std::string_view text);

/// Of all that a skeleton depends on besides the code: the mesh's content, the template, skelgen's version. Empty where
/// the mesh is no regular file or cannot be read.
[[nodiscard]] std::string input_fingerprint(const std::filesystem::path& mesh,
                                            const SkeletonTemplate& skeleton_template);

/// Of a skeleton's file, less its timings, which differ from run to run.
[[nodiscard]] std::string result_fingerprint(const KinematicSkeleton<double>& skeleton,
                                             const std::optional<io::SourceMesh>& mesh);

/// Of a skeleton file that is there already; empty where there is none, or it is none.
[[nodiscard]] std::string result_fingerprint(const std::filesystem::path& file);

} // namespace skelgen::cli
