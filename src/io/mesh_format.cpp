#include <skelgen/io/mesh_format.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace skelgen::io {
namespace {

constexpr std::array<std::string_view, 9> extensions{".off",  ".obj", ".ply", ".stl", ".glb",
                                                     ".gltf", ".vrm", ".fbx", ".dae"};

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

/// "a, b or c"
std::string enumerated(std::span<const std::string_view> words) {
    std::string text(words.front());
    for (std::size_t i = 1; i < words.size(); ++i)
        text += (i + 1 < words.size() ? ", " : " or ") + std::string(words[i]);
    return text;
}

/// The path without ".gz".
std::filesystem::path uncompressed_name(std::filesystem::path path) {
    return has_gzip_extension(path) ? path.replace_extension() : path;
}

} // namespace

bool is_written(MeshFormat format) { return format <= MeshFormat::glb || format == MeshFormat::fbx; }

std::span<const std::string_view> mesh_extensions() { return extensions; }

std::string mesh_extensions_text() { return enumerated(extensions); }

std::string written_mesh_extensions_text() {
    std::vector<std::string_view> written;
    for (std::size_t i = 0; i < extensions.size(); ++i)
        if (is_written(static_cast<MeshFormat>(i))) written.push_back(extensions[i]);
    return enumerated(written);
}

std::optional<MeshFormat> mesh_format_named(std::string_view name) {
    const auto found = std::find(extensions.begin(), extensions.end(), '.' + lower_case(std::string(name)));
    if (found == extensions.end()) return std::nullopt;
    return static_cast<MeshFormat>(found - extensions.begin());
}

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path) {
    const std::string extension = uncompressed_name(path).extension().string();
    return extension.empty() ? std::nullopt : mesh_format_named(std::string_view(extension).substr(1));
}

bool has_gzip_extension(const std::filesystem::path& path) { return lower_case(path.extension().string()) == ".gz"; }

std::filesystem::path without_extensions(const std::filesystem::path& path) {
    return uncompressed_name(path).replace_extension();
}

} // namespace skelgen::io
