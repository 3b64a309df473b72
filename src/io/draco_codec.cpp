#include "draco_codec.hpp"

#include <cstdint>
#include <string>

#include <skelgen/core/error.hpp>

#if SKELGEN_WITH_DRACO
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#endif

namespace skelgen::io::detail {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, "glTF: " + message); }

} // namespace

#if SKELGEN_WITH_DRACO

namespace {

std::vector<double> read_attribute(const draco::Mesh& mesh, const DracoAttribute& wanted) {
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(wanted.id));
    if (attribute == nullptr || static_cast<std::size_t>(attribute->num_components()) != wanted.columns)
        refuse("a Draco mesh lacks attribute " + std::to_string(wanted.id) + " with " + std::to_string(wanted.columns) +
               " components; export the scene again");
    std::vector<double> values(mesh.num_points() * wanted.columns);
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex index = attribute->mapped_index(point);
        double* const row = values.data() + point.value() * wanted.columns;
        if (index.value() >= attribute->size() ||
            !attribute->ConvertValue<double>(index, static_cast<std::int8_t>(wanted.columns), row))
            refuse("a Draco mesh is damaged; export the scene again");
    }
    return values;
}

} // namespace

DracoMesh decode_draco(std::string_view bytes, const std::vector<DracoAttribute>& attributes) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        refuse(std::string("a Draco mesh is damaged (") + decoded.status().error_msg() + "); export the scene again");
    const draco::Mesh& source = *decoded.value();

    DracoMesh mesh;
    mesh.points = source.num_points();
    mesh.triangles.reserve(source.num_faces());
    for (draco::FaceIndex face(0); face < source.num_faces(); ++face) {
        const draco::Mesh::Face& corners = source.face(face);
        mesh.triangles.push_back({corners[0].value(), corners[1].value(), corners[2].value()});
    }
    for (const DracoAttribute& attribute : attributes) mesh.attributes.push_back(read_attribute(source, attribute));
    return mesh;
}

#else

DracoMesh decode_draco(std::string_view, const std::vector<DracoAttribute>&) {
    refuse("the scene is compressed with Draco, which this build of skelgen cannot read; build it with Draco (Debian: "
           "libdraco-dev), or export the scene uncompressed");
}

#endif

} // namespace skelgen::io::detail
