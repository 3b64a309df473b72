#include <skelgen/io/axis_json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/io/read_file.hpp>

#include "json_values.hpp"

namespace skelgen::io {
namespace {

using detail::Json;

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorCode::bad_input, "is no truth file of tubes: " + what +
                                          "; it needs \"axis\" with \"nodes\" [[x, y, z], ...], \"edges\" [[a, b], "
                                          "...] and \"radii\" [r, ...]");
}

const Json& list_in(const Json& axis, const char* key) {
    if (!axis.contains(key) || !axis[key].is_array()) refuse("\"" + std::string(key) + "\" is missing or no list");
    return axis[key];
}

Points<double> read_nodes(const Json& list) {
    Points<double> nodes(static_cast<Eigen::Index>(list.size()), 3);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto point = detail::to_point(list[i]);
        if (!point) refuse("node " + std::to_string(i) + " is no list of three numbers");
        core::set_point(nodes, static_cast<Eigen::Index>(i), *point);
    }
    return nodes;
}

std::vector<std::array<int, 2>> read_edges(const Json& list, int nodes) {
    std::vector<std::array<int, 2>> edges;
    for (const Json& pair : list) {
        const bool two =
            pair.is_array() && pair.size() == 2 && pair[0].is_number_integer() && pair[1].is_number_integer();
        const auto number = [&](std::size_t i) { return pair[i].get<long long>(); };
        if (!two || number(0) < 0 || number(1) < 0 || number(0) >= nodes || number(1) >= nodes ||
            number(0) == number(1))
            refuse("edge " + std::to_string(edges.size()) + " is no pair of different nodes");
        const auto [a, b] = std::minmax({static_cast<int>(number(0)), static_cast<int>(number(1))});
        edges.push_back({a, b});
    }
    if (std::set(edges.begin(), edges.end()).size() != edges.size()) refuse("an edge comes twice");
    return edges;
}

std::vector<double> read_radii(const Json& list) {
    std::vector<double> radii;
    for (const Json& value : list) {
        radii.push_back(value.is_number() ? value.get<double>() : 0.0);
        if (!(radii.back() > 0) || !std::isfinite(radii.back()))
            refuse("radius " + std::to_string(radii.size() - 1) + " is not above zero");
    }
    return radii;
}

bool is_connected(const AxisTruth& truth) {
    std::vector<int> group(truth.radii.size());
    std::iota(group.begin(), group.end(), 0);
    const auto root = [&group](int v) {
        while (group[static_cast<std::size_t>(v)] != v) v = group[static_cast<std::size_t>(v)];
        return v;
    };
    std::size_t groups = group.size();
    for (const auto& [a, b] : truth.edges)
        if (const int from = root(a), to = root(b); from != to) {
            group[static_cast<std::size_t>(from)] = to;
            --groups;
        }
    return groups == 1;
}

} // namespace

int end_count(const AxisTruth& truth) {
    std::vector<int> degree(static_cast<std::size_t>(truth.nodes.rows()), 0);
    for (const auto& edge : truth.edges)
        for (const int node : edge) ++degree[static_cast<std::size_t>(node)];
    return static_cast<int>(std::count(degree.begin(), degree.end(), 1));
}

int cycle_count(const AxisTruth& truth) {
    return static_cast<int>(truth.edges.size()) - static_cast<int>(truth.nodes.rows()) + 1;
}

AxisTruth read_axis_truth(const std::filesystem::path& path) {
    const Json document = detail::parse_json(read_file(path));
    if (!document.is_object() || !document.contains("axis") || !document["axis"].is_object())
        refuse("\"axis\" is missing or no object");
    const Json& axis = document["axis"];
    AxisTruth truth;
    truth.nodes = read_nodes(list_in(axis, "nodes"));
    truth.edges = read_edges(list_in(axis, "edges"), static_cast<int>(truth.nodes.rows()));
    truth.radii = read_radii(list_in(axis, "radii"));
    if (truth.radii.size() != static_cast<std::size_t>(truth.nodes.rows())) refuse("not every node has its radius");
    if (!is_connected(truth)) refuse("its nodes are not connected");
    return truth;
}

} // namespace skelgen::io
