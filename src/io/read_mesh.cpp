#include <skelgen/io/read_mesh.hpp>

#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "assimp_importer.hpp"
#include "companion_file.hpp"
#include "gltf_parser.hpp"
#include "json_values.hpp"
#include "mesh_encoding.hpp"
#include "mesh_parsers.hpp"
#include "plain_content.hpp"

namespace skelgen::io {
namespace {

using detail::Encoding;

PolygonMesh parse(std::string_view content, Encoding encoding, const ReadMeshOptions& options,
                  const detail::LoadCompanion& load) {
    switch (encoding) {
    case Encoding::off:
        return detail::parse_off(content);
    case Encoding::obj:
        return detail::parse_obj(content);
    case Encoding::ply:
        return detail::parse_ply(content);
    case Encoding::stl_text:
        return detail::parse_stl_text(content);
    case Encoding::stl_binary:
        return detail::parse_stl_binary(content);
    case Encoding::gltf:
        return detail::parse_gltf(content, options, load);
    case Encoding::fbx:
        return detail::import_scene(content, MeshFormat::fbx, options);
    case Encoding::dae:
        break;
    }
    return detail::import_scene(content, MeshFormat::dae, options);
}

bool is_scene(Encoding encoding) { return encoding >= Encoding::gltf; }

/// Reads a file's content. `load` gives the files that it refers to.
PolygonMesh read_polygons(std::string_view content, const ReadMeshOptions& options, const detail::LoadCompanion& load) {
    std::string decompressed;
    content = detail::plain_content(content, decompressed);
    if (content.empty()) throw Error(ErrorCode::bad_input, "the file is empty; write it again");
    std::string converted;
    content = detail::with_line_feeds(content, converted);
    const Encoding encoding = detail::encoding_of(content, options.format);
    if (!options.animation.empty() && !is_scene(encoding))
        throw Error(ErrorCode::usage, "has no animations: its format is none for scenes; leave the option out");
    PolygonMesh mesh = parse(content, encoding, options, load);
    if (options.tell && mesh.placeless > 0)
        options.tell(std::to_string(mesh.placeless) + (mesh.placeless == 1 ? " corner" : " corners") +
                     " without a finite place left out, with their faces");
    return mesh;
}

/// As `read_polygons`. Errors may quote what the file holds: their text is valid UTF-8 whatever that is.
PolygonMesh read_telling_errors(std::string_view content, const ReadMeshOptions& options,
                                const detail::LoadCompanion& load) {
    try {
        return read_polygons(content, options, load);
    } catch (const Error& error) {
        throw Error(error.code(), detail::valid_utf8(error.what()));
    }
}

} // namespace

template <typename Scalar>
TriangleMesh<Scalar> parse_mesh(std::string_view content, const ReadMeshOptions& options) {
    return triangulate<Scalar>(read_telling_errors(content, options, detail::refuse_companion));
}

template <typename Scalar>
TriangleMesh<Scalar> parse_mesh(std::string_view content, std::optional<MeshFormat> format) {
    return parse_mesh<Scalar>(content, ReadMeshOptions{format, "", 0, false});
}

template <typename Scalar>
TriangleMesh<Scalar> read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options) {
    ReadMeshOptions named = options;
    if (!named.format) named.format = mesh_format_of(path);
    const auto load = [folder = path.parent_path()](const std::string& reference) {
        return detail::read_companion(folder, reference);
    };
    return triangulate<Scalar>(read_telling_errors(read_file(path), named, load));
}

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template TriangleMesh<Scalar> parse_mesh<Scalar>(std::string_view, const ReadMeshOptions&);                        \
    template TriangleMesh<Scalar> parse_mesh<Scalar>(std::string_view, std::optional<MeshFormat>);                     \
    template TriangleMesh<Scalar> read_mesh<Scalar>(const std::filesystem::path&, const ReadMeshOptions&);
SKELGEN_INSTANTIATE(float)
SKELGEN_INSTANTIATE(double)
#undef SKELGEN_INSTANTIATE

} // namespace skelgen::io
