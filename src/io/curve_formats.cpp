#include <skelgen/io/curve_formats.hpp>

#include <array>
#include <optional>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/read_file.hpp>

#include "file_extension.hpp"

namespace skelgen::io {
namespace {

enum class CurveFormat { json, obj, ply, swc };

constexpr std::array<std::string_view, 4> extensions{".json", ".obj", ".ply", ".swc"};
constexpr const char* known_extensions = "its name must end in .json, .obj, .ply or .swc";

std::optional<CurveFormat> curve_format_of(const std::filesystem::path& path) {
    const auto found = detail::find_extension(path, extensions);
    return found ? std::optional(static_cast<CurveFormat>(*found)) : std::nullopt;
}

template <typename Scalar>
std::string format_curve(const CurveSkeleton<Scalar>& curve, CurveFormat format) {
    switch (format) {
    case CurveFormat::json:
        return curve_to_json(curve);
    case CurveFormat::obj:
        return curve_to_obj(curve);
    case CurveFormat::ply:
        return curve_to_ply(curve);
    case CurveFormat::swc:
        break;
    }
    return curve_to_swc(curve);
}

template <typename Scalar>
CurveSkeleton<Scalar> parse_curve(std::string_view content, CurveFormat format) {
    switch (format) {
    case CurveFormat::json:
        return curve_from_json<Scalar>(content);
    case CurveFormat::obj:
        return curve_from_obj<Scalar>(content);
    case CurveFormat::ply:
        return curve_from_ply<Scalar>(content);
    case CurveFormat::swc:
        break;
    }
    return curve_from_swc<Scalar>(content);
}

} // namespace

std::span<const std::string_view> curve_extensions() { return extensions; }

template <typename Scalar>
void write_curve(const std::filesystem::path& path, const CurveSkeleton<Scalar>& curve) {
    const std::optional<CurveFormat> format = curve_format_of(path);
    if (!format)
        throw Error(ErrorCode::usage,
                    std::string("a curve skeleton cannot be written to this file: ") + known_extensions);
    write_file_atomically(path, format_curve(curve, *format));
}

template <typename Scalar>
CurveSkeleton<Scalar> read_curve(const std::filesystem::path& path) {
    const std::optional<CurveFormat> format = curve_format_of(path);
    if (!format)
        throw Error(ErrorCode::bad_input, std::string("is no curve skeleton in a known format: ") + known_extensions);
    const std::string content = read_file(path);
    std::string_view text = content;
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF"; // of UTF-8
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    return parse_curve<Scalar>(text, *format);
}

template void write_curve<float>(const std::filesystem::path&, const CurveSkeleton<float>&);
template void write_curve<double>(const std::filesystem::path&, const CurveSkeleton<double>&);
template CurveSkeleton<float> read_curve<float>(const std::filesystem::path&);
template CurveSkeleton<double> read_curve<double>(const std::filesystem::path&);

} // namespace skelgen::io
