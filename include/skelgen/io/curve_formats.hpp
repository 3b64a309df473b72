#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen::io {

/// A curve skeleton as text, ready for a file or for standard output. Numbers are the shortest that read back the same.
/// `radii` and `regions` may be empty. `Scalar` is float or double.
/// \throws Error usage when a coordinate or radius is not finite, an edge names no node, or `radii` or `regions` are
///         neither empty nor one for each node.

/// JSON, the only format that keeps everything: {"format": "skelgen-curve", "version": 1, "nodes": [[x, y, z], ...],
/// "edges": [[i, j], ...], "radii": [r, ...], "regions": [[vertex, ...], ...]}, indices counted from 0; the last two
/// are left out when empty.
template <typename Scalar>
[[nodiscard]] std::string curve_to_json(const CurveSkeleton<Scalar>& curve);

/// Wavefront OBJ: nodes as `v`, edges as `l`.
template <typename Scalar>
[[nodiscard]] std::string curve_to_obj(const CurveSkeleton<Scalar>& curve);

/// PLY, text: an element `vertex` with x, y, z and, if known, radius; an element `edge` with vertex1 and vertex2.
template <typename Scalar>
[[nodiscard]] std::string curve_to_ply(const CurveSkeleton<Scalar>& curve);

/// SWC, the trees of neuroscience: `id type x y z radius parent`, type 0, ids from 1 with parents first. Each component
/// becomes a tree of shortest hops from its node of lowest index, whose parent is -1. SWC holds no cycles: an edge that
/// closes one is left out and named in the header. An unknown radius is 0. The unit is the mesh's own.
template <typename Scalar>
[[nodiscard]] std::string curve_to_swc(const CurveSkeleton<Scalar>& curve);

/// Writes one of the above by the extension of `path`: .json, .obj, .ply or .swc. Whole or not at all (see
/// `write_file_atomically`).
/// \throws Error usage also when the extension is none of these; as `write_file_atomically` when the file cannot be
///         written.
template <typename Scalar>
void write_curve(const std::filesystem::path& path, const CurveSkeleton<Scalar>& curve);

/// The inverse of `curve_to_json`. Members it does not know are ignored.
/// \throws Error bad_input when `text` is no JSON, no skelgen-curve of version 1, or contradicts itself.
template <typename Scalar = double>
[[nodiscard]] CurveSkeleton<Scalar> curve_from_json(std::string_view text);

/// Reads a JSON file that `write_curve` wrote. \throws Error bad_input as `curve_from_json`, or when it cannot be read.
template <typename Scalar = double>
[[nodiscard]] CurveSkeleton<Scalar> read_curve(const std::filesystem::path& path);

} // namespace skelgen::io

namespace skelgen {
using io::read_curve;
using io::write_curve;
} // namespace skelgen
