#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/stage_timings.hpp>

namespace skelgen::io {

/// The mesh that a skeleton was found in, as far as the skeleton's file tells.
struct SourceMesh {
    std::string file; ///< the file's name without its folders, so that results do not depend on where they were made
    std::int64_t vertices = 0;
    std::int64_t faces = 0;
    double geodesic_diameter = 0; ///< in the mesh's own unit
};

/// Wall-clock milliseconds behind a skeleton file; `stages.total` includes `read`.
struct FileTimings {
    double read = 0;
    StageTimings stages;
};

/// What a skeleton's file says besides the skeleton. A skeleton made by hand or by a program has neither.
struct SkeletonProvenance {
    std::optional<SourceMesh> mesh;
    std::optional<FileTimings> timings_ms;
    /// Of first joints of digits: other digits that are one with it on the surface.
    std::vector<std::pair<std::string, std::vector<std::string>>> fused = {};
};

/// The skeleton as the text of a skeleton file (data/schema/skeleton.schema.json). JSON in UTF-8, keys in fixed order,
/// one joint a line, numbers in the shortest form that reads back as the same `Scalar`. Instantiated for float and
/// double. O(joints).
/// \throws Error internal when a number is not finite: such a file could not be read back.
template <typename Scalar>
[[nodiscard]] std::string skeleton_to_json(const KinematicSkeleton<Scalar>& skeleton,
                                           const SkeletonProvenance& provenance = {});

/// Writes `skeleton_to_json` to a file, wholly or not at all.
/// \throws Error as `skeleton_to_json`, and as `write_file_atomically` when the file cannot be written.
template <typename Scalar>
void write_skeleton(const std::filesystem::path& path, const KinematicSkeleton<Scalar>& skeleton,
                    const SkeletonProvenance& provenance = {});

/// A skeleton file's content.
struct SkeletonDocument {
    KinematicSkeleton<double> skeleton;
    SkeletonProvenance provenance;
};

/// Reads the text of a skeleton file. Keys it does not know are ignored.
/// \throws Error bad_input saying which part is missing or malformed.
[[nodiscard]] SkeletonDocument parse_skeleton_document(std::string_view json);

/// Reads a skeleton file, with what it says about the mesh.
/// \throws Error bad_input when it cannot be read or is no skeleton file.
[[nodiscard]] SkeletonDocument read_skeleton_document(const std::filesystem::path& path);

/// Reads the skeleton alone from a skeleton file.
/// \throws Error bad_input when it cannot be read or is no skeleton file.
[[nodiscard]] KinematicSkeleton<double> read_skeleton(const std::filesystem::path& path);

} // namespace skelgen::io

namespace skelgen {
using io::read_skeleton;
using io::skeleton_to_json;
using io::write_skeleton;
} // namespace skelgen
