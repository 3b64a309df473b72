#include <skelgen/io/curve_formats.hpp>

#include <array>
#include <queue>
#include <type_traits>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>

#include "curve_checks.hpp"
#include "number_text.hpp"

namespace skelgen::io {
namespace {

using detail::append_number;
using detail::append_point;

void append_pair(std::string& text, int a, int b) {
    append_number(text, a);
    text += ' ';
    append_number(text, b);
    text += '\n';
}

/// Trees that reach every node of a curve skeleton.
struct SpanningForest {
    std::vector<int> order;                   ///< all nodes, parents before children
    std::vector<int> parents;                 ///< per node; -1 at a root
    std::vector<std::array<int, 2>> left_out; ///< the edges that close cycles
};

std::vector<std::vector<std::size_t>> edges_at_nodes(std::size_t nodes, const std::vector<std::array<int, 2>>& edges) {
    std::vector<std::vector<std::size_t>> at(nodes);
    for (std::size_t edge = 0; edge < edges.size(); ++edge)
        for (const int node : edges[edge]) at[static_cast<std::size_t>(node)].push_back(edge);
    return at;
}

/// Sets a flag; returns what it was.
bool set(std::vector<bool>& flags, std::size_t i) {
    const bool was = flags[i];
    flags[i] = true;
    return was;
}

SpanningForest spanning_forest(std::size_t nodes, const std::vector<std::array<int, 2>>& edges) {
    const auto at = edges_at_nodes(nodes, edges);
    SpanningForest forest;
    forest.parents.assign(nodes, -1);
    std::vector<bool> reached(nodes, false), used(edges.size(), false);
    for (std::size_t root = 0; root < nodes; ++root) {
        if (set(reached, root)) continue;
        std::queue<int> queue({static_cast<int>(root)});
        for (; !queue.empty(); queue.pop()) {
            const int node = queue.front();
            forest.order.push_back(node);
            for (const std::size_t edge : at[static_cast<std::size_t>(node)]) {
                if (set(used, edge)) continue;
                const int other = edges[edge][0] == node ? edges[edge][1] : edges[edge][0];
                if (set(reached, static_cast<std::size_t>(other))) {
                    forest.left_out.push_back(edges[edge]);
                    continue;
                }
                forest.parents[static_cast<std::size_t>(other)] = node;
                queue.push(other);
            }
        }
    }
    return forest;
}

std::vector<int> swc_ids(const SpanningForest& forest) {
    std::vector<int> ids(forest.order.size());
    int next = 1;
    for (const int node : forest.order) ids[static_cast<std::size_t>(node)] = next++;
    return ids;
}

} // namespace

template <typename Scalar>
std::string curve_to_obj(const CurveSkeleton<Scalar>& curve) {
    detail::check_curve(curve, ErrorCode::usage);
    std::string text = "# skelgen curve skeleton\n";
    for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i) {
        text += "v ";
        append_point(text, curve.nodes.row(i));
        text += '\n';
    }
    for (const auto& [a, b] : curve.edges) {
        text += "l ";
        append_pair(text, a + 1, b + 1);
    }
    return text;
}

template <typename Scalar>
std::string curve_to_ply(const CurveSkeleton<Scalar>& curve) {
    detail::check_curve(curve, ErrorCode::usage);
    const std::string type = std::is_same_v<Scalar, float> ? "float" : "double";
    std::string text = "ply\nformat ascii 1.0\ncomment skelgen curve skeleton\nelement vertex ";
    append_number(text, curve.nodes.rows());
    for (const char* axis : {"x", "y", "z"}) text += "\nproperty " + type + " " + axis;
    if (!curve.radii.empty()) text += "\nproperty " + type + " radius";
    text += "\nelement edge ";
    append_number(text, curve.edges.size());
    text += "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
    for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i) {
        append_point(text, curve.nodes.row(i));
        if (!curve.radii.empty()) {
            text += ' ';
            append_number(text, curve.radii[static_cast<std::size_t>(i)]);
        }
        text += '\n';
    }
    for (const auto& [a, b] : curve.edges) append_pair(text, a, b);
    return text;
}

template <typename Scalar>
std::string curve_to_swc(const CurveSkeleton<Scalar>& curve) {
    detail::check_curve(curve, ErrorCode::usage);
    const SpanningForest forest = spanning_forest(static_cast<std::size_t>(curve.nodes.rows()), curve.edges);
    const std::vector<int> ids = swc_ids(forest);
    const auto id_of = [&ids](int node) { return node < 0 ? -1 : ids[static_cast<std::size_t>(node)]; };

    std::string text = "# skelgen curve skeleton, in the unit of its mesh\n";
    for (const auto& [a, b] : forest.left_out) {
        text += "# left out, as it closes a cycle: the edge between ";
        append_pair(text, id_of(a), id_of(b));
    }
    text += "# id type x y z radius parent\n";
    for (const int node : forest.order) {
        append_number(text, id_of(node));
        text += " 0 "; // type 0: undefined
        append_point(text, curve.nodes.row(node));
        text += ' ';
        append_number(text, curve.radii.empty() ? Scalar{0} : curve.radii[static_cast<std::size_t>(node)]);
        text += ' ';
        append_number(text, id_of(forest.parents[static_cast<std::size_t>(node)]));
        text += '\n';
    }
    return text;
}

template <typename Scalar>
void write_curve(const std::filesystem::path& path, const CurveSkeleton<Scalar>& curve) {
    const std::string extension = path.extension().string();
    if (extension == ".json") return write_file_atomically(path, curve_to_json(curve));
    if (extension == ".obj") return write_file_atomically(path, curve_to_obj(curve));
    if (extension == ".ply") return write_file_atomically(path, curve_to_ply(curve));
    if (extension == ".swc") return write_file_atomically(path, curve_to_swc(curve));
    throw Error(ErrorCode::usage, "a curve skeleton cannot be written to this file: its name must end in .json, .obj, "
                                  ".ply or .swc");
}

template std::string curve_to_obj<float>(const CurveSkeleton<float>&);
template std::string curve_to_obj<double>(const CurveSkeleton<double>&);
template std::string curve_to_ply<float>(const CurveSkeleton<float>&);
template std::string curve_to_ply<double>(const CurveSkeleton<double>&);
template std::string curve_to_swc<float>(const CurveSkeleton<float>&);
template std::string curve_to_swc<double>(const CurveSkeleton<double>&);
template void write_curve<float>(const std::filesystem::path&, const CurveSkeleton<float>&);
template void write_curve<double>(const std::filesystem::path&, const CurveSkeleton<double>&);

} // namespace skelgen::io
