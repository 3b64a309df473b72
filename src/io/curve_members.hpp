#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "curve_builder.hpp"
#include "json_values.hpp"

namespace skelgen::io::detail {

/// Throws, with what is wrong in its message.
using Refuse = void (*)(const std::string& what);

/// Where in a document something is: `nodes[3]: `.
inline std::string place_in(const char* list, std::size_t i) {
    return std::string(list) + "[" + std::to_string(i) + "]: ";
}

inline const Json& list_member(const Json& object, const char* name, Refuse refuse) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_array()) refuse(std::string("it lacks the list '") + name + "'");
    return *found;
}

inline const Json& list_of(const Json& value, std::size_t size, const std::string& what, Refuse refuse) {
    if (!value.is_array() || value.size() != size) refuse(what + " is no list of " + std::to_string(size) + " numbers");
    return value;
}

template <typename Scalar>
Scalar to_number(const Json& value, const std::string& where, Refuse refuse) {
    if (!value.is_number()) refuse(where + "a coordinate or radius is no number");
    const Scalar number = value.get<Scalar>();
    if (!std::isfinite(number)) refuse(where + "a coordinate or radius is too large");
    return number;
}

inline int to_index(const Json& value, const std::string& where, Refuse refuse) {
    if (!value.is_number_integer()) refuse(where + "an index is no whole number");
    const bool fits = !value.is_number_unsigned() || value.get<std::uint64_t>() <= std::numeric_limits<int>::max();
    const auto index = fits ? value.get<std::int64_t>() : -1;
    if (index < 0 || index > std::numeric_limits<int>::max()) refuse(where + "an index is negative or too large");
    return static_cast<int>(index);
}

template <typename Scalar>
void add_nodes(CurveBuilder<Scalar>& builder, const Json& nodes, const Json* radii, Refuse refuse) {
    if (radii != nullptr && !radii->empty() && radii->size() != nodes.size())
        refuse("there is not one radius for each node");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::string where = place_in("nodes", i);
        const Json& node = list_of(nodes[i], 3, where + "a node", refuse);
        const auto coordinate = [&](std::size_t axis) { return to_number<Scalar>(node[axis], where, refuse); };
        builder.add_node({coordinate(0), coordinate(1), coordinate(2)},
                         [&](const std::string& what) { refuse(where + what); });
        if (radii == nullptr || radii->empty()) continue;
        const std::string radius_place = place_in("radii", i);
        builder.add_radius(to_number<Scalar>((*radii)[i], radius_place, refuse),
                           [&](const std::string& what) { refuse(radius_place + what); });
    }
}

template <typename Scalar>
void add_edges(CurveBuilder<Scalar>& builder, const Json& edges, Refuse refuse) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const std::string where = place_in("edges", i);
        const Json& edge = list_of(edges[i], 2, where + "an edge", refuse);
        builder.add_edge(to_index(edge[0], where, refuse), to_index(edge[1], where, refuse), builder.node_count(),
                         [&](const std::string& what) { refuse(where + what); });
    }
}

/// The curve skeleton in an object with the members "nodes" [[x, y, z], ...], "edges" [[a, b], ...] and, if known,
/// "radii" [r, ...]; its edges in ascending order. Other members are skipped.
template <typename Scalar>
CurveSkeleton<Scalar> curve_from_members(const Json& object, Refuse refuse) {
    CurveBuilder<Scalar> builder(0);
    const Json& nodes = list_member(object, "nodes", refuse);
    const Json& edges = list_member(object, "edges", refuse);
    add_nodes(builder, nodes, object.contains("radii") ? &list_member(object, "radii", refuse) : nullptr, refuse);
    add_edges(builder, edges, refuse);
    return builder.finish(refuse);
}

} // namespace skelgen::io::detail
