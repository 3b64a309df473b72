#include <skelgen/io/curve_formats.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "curve_checks.hpp"
#include "json_values.hpp"
#include "number_text.hpp"

namespace skelgen::io {
namespace {

using detail::Json;

constexpr std::string_view format_name = "skelgen-curve";
constexpr int format_version = 1;

[[noreturn]] void throw_bad_curve(const std::string& message) {
    throw Error(ErrorCode::bad_input, "is no curve skeleton: " + message + "; write it again");
}

/// `"name": [one row a line]`, the rows' texts by `append_row(text, i)`.
template <typename AppendRow>
void append_rows(std::string& text, const char* name, std::size_t count, const AppendRow& append_row) {
    text += std::string(",\n  \"") + name + "\": [";
    for (std::size_t i = 0; i < count; ++i) {
        text += i == 0 ? "\n    " : ",\n    ";
        append_row(text, i);
    }
    text += count == 0 ? "]" : "\n  ]";
}

const Json& member(const Json& document, const char* name) {
    const auto found = document.find(name);
    if (found == document.end() || !found->is_array()) throw_bad_curve(std::string("it lacks the list '") + name + "'");
    return *found;
}

template <typename Scalar>
Scalar to_number(const Json& value) {
    if (!value.is_number()) throw_bad_curve("a coordinate or radius is no number");
    const Scalar number = value.get<Scalar>();
    if (!std::isfinite(number)) throw_bad_curve("a coordinate or radius is too large");
    return number;
}

int to_index(const Json& value) {
    if (!value.is_number_integer()) throw_bad_curve("an index is no whole number");
    const bool fits = !value.is_number_unsigned() || value.get<std::uint64_t>() <= std::numeric_limits<int>::max();
    const auto index = fits ? value.get<std::int64_t>() : -1;
    if (index < 0 || index > std::numeric_limits<int>::max()) throw_bad_curve("an index is negative or too large");
    return static_cast<int>(index);
}

const Json& list_of(const Json& value, std::size_t size, const char* what) {
    if (!value.is_array() || value.size() != size)
        throw_bad_curve(std::string(what) + " is no list of " + std::to_string(size) + " numbers");
    return value;
}

void check_head(const Json& document) {
    if (!document.is_object() || !document.contains("format") || document["format"] != format_name)
        throw_bad_curve("its \"format\" is not \"" + std::string(format_name) + "\"");
    if (!document.contains("version") || document["version"] != format_version)
        throw_bad_curve("its \"version\" is not " + std::to_string(format_version) +
                        ", the only one that this skelgen reads");
}

template <typename Scalar>
Points<Scalar> to_nodes(const Json& list) {
    Points<Scalar> nodes(static_cast<Eigen::Index>(list.size()), 3);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Json& node = list_of(list[i], 3, "a node");
        for (std::size_t axis = 0; axis < 3; ++axis)
            nodes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis)) = to_number<Scalar>(node[axis]);
    }
    return nodes;
}

std::vector<std::vector<int>> to_regions(const Json& list) {
    std::vector<std::vector<int>> regions(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (!list[i].is_array()) throw_bad_curve("a region is no list");
        for (const Json& vertex : list[i]) regions[i].push_back(to_index(vertex));
    }
    return regions;
}

} // namespace

template <typename Scalar>
std::string curve_to_json(const CurveSkeleton<Scalar>& curve) {
    detail::check_curve(curve, ErrorCode::usage);
    using detail::append_number;
    std::string text = "{\n  \"format\": \"" + std::string(format_name) + "\",\n  \"version\": ";
    append_number(text, format_version);
    append_rows(text, "nodes", static_cast<std::size_t>(curve.nodes.rows()), [&](std::string& row, std::size_t i) {
        row += '[';
        detail::append_point(row, curve.nodes.row(static_cast<Eigen::Index>(i)), ", ");
        row += ']';
    });
    append_rows(text, "edges", curve.edges.size(), [&](std::string& row, std::size_t i) {
        row += '[';
        append_number(row, curve.edges[i][0]);
        row += ", ";
        append_number(row, curve.edges[i][1]);
        row += ']';
    });
    if (!curve.radii.empty())
        append_rows(text, "radii", curve.radii.size(),
                    [&](std::string& row, std::size_t i) { append_number(row, curve.radii[i]); });
    if (!curve.regions.empty())
        append_rows(text, "regions", curve.regions.size(), [&](std::string& row, std::size_t i) {
            row += '[';
            for (std::size_t k = 0; k < curve.regions[i].size(); ++k) {
                if (k > 0) row += ", ";
                append_number(row, curve.regions[i][k]);
            }
            row += ']';
        });
    return text + "\n}\n";
}

template <typename Scalar>
CurveSkeleton<Scalar> curve_from_json(std::string_view text) {
    const Json document = detail::parse_json(text);
    check_head(document);
    CurveSkeleton<Scalar> curve;
    curve.nodes = to_nodes<Scalar>(member(document, "nodes"));
    for (const Json& edge : member(document, "edges")) {
        list_of(edge, 2, "an edge");
        curve.edges.push_back({to_index(edge[0]), to_index(edge[1])});
    }
    if (document.contains("radii"))
        for (const Json& radius : member(document, "radii")) curve.radii.push_back(to_number<Scalar>(radius));
    if (document.contains("regions")) curve.regions = to_regions(member(document, "regions"));
    detail::check_curve(curve, ErrorCode::bad_input);
    return curve;
}

template <typename Scalar>
CurveSkeleton<Scalar> read_curve(const std::filesystem::path& path) {
    return curve_from_json<Scalar>(read_file(path));
}

template std::string curve_to_json<float>(const CurveSkeleton<float>&);
template std::string curve_to_json<double>(const CurveSkeleton<double>&);
template CurveSkeleton<float> curve_from_json<float>(std::string_view);
template CurveSkeleton<double> curve_from_json<double>(std::string_view);
template CurveSkeleton<float> read_curve<float>(const std::filesystem::path&);
template CurveSkeleton<double> read_curve<double>(const std::filesystem::path&);

} // namespace skelgen::io
