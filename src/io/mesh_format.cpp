#include <skelgen/io/mesh_format.hpp>

#include <array>

#include "file_extension.hpp"

namespace skelgen::io {
namespace {

constexpr std::array<std::string_view, 4> extensions{".off", ".obj", ".ply", ".stl"};

} // namespace

std::span<const std::string_view> mesh_extensions() { return extensions; }

std::string mesh_extensions_text() {
    std::string text(extensions.front());
    for (std::size_t i = 1; i < extensions.size(); ++i)
        text += (i + 1 < extensions.size() ? ", " : " or ") + std::string(extensions[i]);
    return text;
}

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path) {
    const auto found = detail::find_extension(path, extensions);
    return found ? std::optional(static_cast<MeshFormat>(*found)) : std::nullopt;
}

} // namespace skelgen::io
