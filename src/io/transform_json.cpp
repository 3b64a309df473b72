#include <skelgen/io/transform_json.hpp>

#include <skelgen/core/error.hpp>

#include "json_values.hpp"

namespace skelgen::io {
namespace {

constexpr const char* format_name = "skelgen-transform";
constexpr int format_version = 1;

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorCode::bad_input, "is no transform file: " + what + "; write it with `skelgen align`");
}

} // namespace

std::string transform_to_json(const Eigen::Matrix4d& matrix) {
    if (!matrix.allFinite()) throw Error(ErrorCode::internal, "the transform holds a number that is not finite");
    detail::Json rows = detail::Json::array();
    for (int i = 0; i < 4; ++i) rows.push_back({matrix(i, 0), matrix(i, 1), matrix(i, 2), matrix(i, 3)});
    return detail::Json{{"format", format_name}, {"version", format_version}, {"matrix", rows}}.dump() + "\n";
}

Eigen::Matrix4d parse_transform(std::string_view json) {
    const detail::Json file = detail::parse_json(json);
    if (!file.is_object() || file.value("format", detail::Json()) != format_name)
        refuse("its \"format\" is not \"" + std::string(format_name) + "\"");
    if (file.value("version", detail::Json()) != format_version)
        throw Error(ErrorCode::bad_input, "is a transform file of a version other than " +
                                              std::to_string(format_version) + ", the one this skelgen reads");
    const detail::Json rows = file.value("matrix", detail::Json());
    if (!rows.is_array() || rows.size() != 4) refuse("\"matrix\" is no list of four rows");
    Eigen::Matrix4d matrix;
    for (std::size_t i = 0; i < 4; ++i) {
        if (!rows[i].is_array() || rows[i].size() != 4) refuse("a row of \"matrix\" is no list of four numbers");
        for (std::size_t k = 0; k < 4; ++k) {
            if (!rows[i][k].is_number()) refuse("a row of \"matrix\" is no list of four numbers");
            matrix(static_cast<int>(i), static_cast<int>(k)) = rows[i][k].get<double>();
        }
    }
    return matrix;
}

} // namespace skelgen::io
