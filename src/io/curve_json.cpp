#include <skelgen/io/curve_formats.hpp>

#include <cmath>

#include <fast_float/fast_float.h>

#include <skelgen/core/error.hpp>

#include "curve_checks.hpp"
#include "curve_members.hpp"
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

void check_head(const Json& document) {
    if (!document.is_object() || !document.contains("format") || document["format"] != format_name)
        throw_bad_curve("its \"format\" is not \"" + std::string(format_name) + "\"");
    if (!document.contains("version") || document["version"] != format_version)
        throw_bad_curve("its \"version\" is not " + std::to_string(format_version) +
                        ", the only one that this skelgen reads");
}

std::vector<std::vector<int>> to_regions(const Json& list, Eigen::Index nodes) {
    if (!list.empty() && list.size() != static_cast<std::size_t>(nodes))
        throw_bad_curve("there is not one region for each node");
    std::vector<std::vector<int>> regions(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string where = detail::place_in("regions", i);
        if (!list[i].is_array()) throw_bad_curve(where + "a region is no list");
        for (const Json& vertex : list[i]) regions[i].push_back(detail::to_index(vertex, where, throw_bad_curve));
    }
    return regions;
}

/// As `detail::append_number`, for readers of JSON: they go by way of double, and take "-0" for the whole number 0.
template <typename Scalar>
void append_json_number(std::string& text, Scalar value) {
    if (value == 0) {
        text += std::signbit(value) ? "-0.0" : "0";
        return;
    }
    std::string shortest;
    detail::append_number(shortest, value);
    double read = 0;
    fast_float::from_chars(shortest.data(), shortest.data() + shortest.size(), read);
    // Of all floats this is so for +-7.038531e-26 alone: rounded twice, its text becomes its neighbour.
    if (static_cast<Scalar>(read) != value) {
        shortest.clear();
        detail::append_number(shortest, static_cast<double>(value));
    }
    text += shortest;
}

} // namespace

template <typename Scalar>
std::string curve_to_json(const CurveSkeleton<Scalar>& curve) {
    detail::check_curve(curve, ErrorCode::usage);
    using detail::append_number;
    std::string text = "{\n  \"format\": \"" + std::string(format_name) + "\",\n  \"version\": ";
    append_number(text, format_version);
    append_rows(text, "nodes", static_cast<std::size_t>(curve.nodes.rows()), [&](std::string& row, std::size_t i) {
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            row += axis == 0 ? "[" : ", ";
            append_json_number(row, curve.nodes(static_cast<Eigen::Index>(i), axis));
        }
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
                    [&](std::string& row, std::size_t i) { append_json_number(row, curve.radii[i]); });
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
    auto curve = detail::curve_from_members<Scalar>(document, throw_bad_curve);
    if (document.contains("regions"))
        curve.regions = to_regions(detail::list_member(document, "regions", throw_bad_curve), curve.nodes.rows());
    return curve;
}

template std::string curve_to_json<float>(const CurveSkeleton<float>&);
template std::string curve_to_json<double>(const CurveSkeleton<double>&);
template CurveSkeleton<float> curve_from_json<float>(std::string_view);
template CurveSkeleton<double> curve_from_json<double>(std::string_view);

} // namespace skelgen::io
