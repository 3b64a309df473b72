#include <skelgen/io/mesh_format.hpp>

#include <algorithm>
#include <array>

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
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    const auto found = std::find(extensions.begin(), extensions.end(), extension);
    if (found == extensions.end()) return std::nullopt;
    return static_cast<MeshFormat>(found - extensions.begin());
}

} // namespace skelgen::io
