#include <skelgen/io/axis_json.hpp>

#include <algorithm>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "curve_members.hpp"
#include "json_values.hpp"

namespace skelgen::io {
namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorCode::bad_input, "is no truth file of tubes: " + what +
                                          "; it needs \"axis\" with \"nodes\" [[x, y, z], ...], \"edges\" [[a, b], "
                                          "...] and \"radii\" [r, ...]");
}

} // namespace

CurveSkeleton<double> read_axis_truth(const std::filesystem::path& path) {
    const detail::Json document = detail::parse_json(read_file(path));
    if (!document.is_object() || !document.contains("axis") || !document["axis"].is_object())
        refuse("\"axis\" is missing or no object");
    CurveSkeleton<double> axis = detail::curve_from_members<double>(document["axis"], refuse);
    if (axis.radii.empty()) refuse("it lacks the list 'radii'");
    if (const auto zero = std::find(axis.radii.begin(), axis.radii.end(), 0.0); zero != axis.radii.end())
        refuse(detail::place_in("radii", static_cast<std::size_t>(zero - axis.radii.begin())) + "a radius is 0");
    if (core::component_count(axis) != 1) refuse("its nodes are not connected");
    return axis;
}

} // namespace skelgen::io
