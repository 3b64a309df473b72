#include <skelgen/io/mesh_format.hpp>

#include <algorithm>
#include <string>

namespace skelgen {

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (extension == ".off") return MeshFormat::off;
    if (extension == ".obj") return MeshFormat::obj;
    if (extension == ".ply") return MeshFormat::ply;
    if (extension == ".stl") return MeshFormat::stl;
    return std::nullopt;
}

} // namespace skelgen
