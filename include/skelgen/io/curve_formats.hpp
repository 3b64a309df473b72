#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen::io {

/// A curve skeleton as text, ready for a file or for standard output, and back. Numbers are the shortest that read back
/// the same, bit by bit; `Scalar` is float or double. `radii` and `regions` may be empty. Edges are read as pairs of
/// ascending indices in ascending order, whatever the file's. Time is linear, but for the edges, which are sorted.
///
/// Every `curve_to_...` throws Error usage when there are no nodes, a coordinate or radius is not finite, or a radius
/// is negative. It throws it, too, when an edge names no node, is there twice or goes from a node to itself. So it does
/// when `radii` or `regions` are neither empty nor one for each node.
///
/// Every `curve_from_...` throws Error bad_input when the text is not of its format or is no such curve skeleton. The
/// message names the line (of binary data the byte, of JSON the member) and what is wrong with it. None allocates more
/// than a multiple of the text's size, whatever its header claims.

/// JSON, the only format that keeps everything. {"format": "skelgen-curve", "version": 1, "nodes": [[x, y, z], ...],
/// "edges": [[i, j], ...], "radii": [r, ...], "regions": [[vertex, ...], ...]}, indices counted from 0. The last two
/// are left out when empty.
template <typename Scalar>
[[nodiscard]] std::string curve_to_json(const CurveSkeleton<Scalar>& curve);

/// Members it does not know are ignored.
template <typename Scalar = double>
[[nodiscard]] CurveSkeleton<Scalar> curve_from_json(std::string_view text);

/// Wavefront OBJ: nodes as `v`, edges as `l`, both in their order. A radius is a comment behind its node, `# radius r`:
/// other programs skip it.
template <typename Scalar>
[[nodiscard]] std::string curve_to_obj(const CurveSkeleton<Scalar>& curve);

/// Reads lines of any length (`l a b c` are two edges), indices that count backwards, and nodes that follow their
/// lines. Weights and colours of nodes, groups, normals, texture coordinates and materials are skipped; faces are
/// refused: what has them is a mesh. No regions.
template <typename Scalar = double>
[[nodiscard]] CurveSkeleton<Scalar> curve_from_obj(std::string_view text);

/// PLY, text: an element `vertex` with x, y, z and, if known, radius; an element `edge` with vertex1 and vertex2.
template <typename Scalar>
[[nodiscard]] std::string curve_to_ply(const CurveSkeleton<Scalar>& curve);

/// Reads PLY 1.0, text or binary of either byte order, with further elements and properties, which are skipped; faces
/// are refused: what has them is a mesh. No regions.
template <typename Scalar = double>
[[nodiscard]] CurveSkeleton<Scalar> curve_from_ply(std::string_view bytes);

/// SWC, the trees of neuroscience: `id type x y z radius parent`, type 0 (undefined), ids 1, 2, 3, ... with parents
/// first. Each component becomes one tree, whose root is its node of lowest index and has the parent -1. The header
/// names skelgen and the unit, which is that of the mesh.
///
/// Nodes keep their order (id = index + 1) where every node but the first of its component has a neighbour of lower
/// index. Else they are numbered anew, by rising number of edges to the root, one component after the other.
///
/// What a tree cannot hold is told in comments, one line each. `curve_from_swc` reads it back from them.
/// - `# left out, as it closes a cycle: the edge between I J`, with two ids, as the parents hold no cycles;
/// - `# radii unknown, a placeholder in their column`, as each radius has to be positive;
/// - `# radius 0, a placeholder in its column: node I`, likewise.
///
/// The placeholder is a thousandth of the curve's largest extent, or 1 where that is 0.
template <typename Scalar>
[[nodiscard]] std::string curve_to_swc(const CurveSkeleton<Scalar>& curve);

/// Nodes come in the order of their ids. Wants what the format's rules say: seven numbers a line, ids 1, 2, 3, ...
/// without gaps, parents (-1 for none) before their children. Types are skipped; a radius may be 0. No regions.
template <typename Scalar = double>
[[nodiscard]] CurveSkeleton<Scalar> curve_from_swc(std::string_view text);

/// The formats' extensions: ".json", ".obj", ".ply" and ".swc".
[[nodiscard]] std::span<const std::string_view> curve_extensions();

/// Writes one of the above by the extension of `path`, whatever its case: .json, .obj, .ply or .swc. Whole or not at
/// all (see `write_file_atomically`). \throws Error usage also when the extension is none of these; as
/// `write_file_atomically` when the file cannot be
///         written.
template <typename Scalar>
void write_curve(const std::filesystem::path& path, const CurveSkeleton<Scalar>& curve);

/// Reads one of the above by the extension of `path`, as `write_curve` chooses it.
/// \throws Error bad_input as the formats' own, when the extension is none of them, or when the file cannot be read.
template <typename Scalar = double>
[[nodiscard]] CurveSkeleton<Scalar> read_curve(const std::filesystem::path& path);

} // namespace skelgen::io

namespace skelgen {
using io::read_curve;
using io::write_curve;
} // namespace skelgen
