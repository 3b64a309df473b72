#include "glb_writer.hpp"

#include <cstdint>
#include <utility>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/version.hpp>

#include "little_endian.hpp"

namespace skelgen::io::detail {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorCode::usage, "the mesh cannot be written: " + message);
}

Json to_json(const Eigen::RowVector3f& point) {
    // As double: JSON then has every digit, and the limits are exactly those of the data.
    return {static_cast<double>(point[0]), static_cast<double>(point[1]), static_cast<double>(point[2])};
}

Json describe(const Points<float>& vertices, std::size_t indices) {
    constexpr int type_float = 5126, type_unsigned_int = 5125, target_vertices = 34962, target_indices = 34963;
    const std::size_t vertex_bytes = static_cast<std::size_t>(vertices.size()) * sizeof(float);
    const std::size_t index_bytes = indices * sizeof(std::uint32_t);
    Json json;
    json["asset"] = {{"version", "2.0"}, {"generator", "skelgen " + std::string(version)}};
    json["scene"] = 0;
    json["scenes"] = Json::array({{{"nodes", {0}}}});
    json["nodes"] = Json::array({{{"mesh", 0}}});
    json["meshes"] =
        Json::array({{{"primitives", Json::array({{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}})}}});
    json["accessors"] = Json::array(
        {{{"bufferView", 0},
          {"componentType", type_float},
          {"count", vertices.rows()},
          {"type", "VEC3"},
          {"min", to_json(vertices.colwise().minCoeff())},
          {"max", to_json(vertices.colwise().maxCoeff())}},
         {{"bufferView", 1}, {"componentType", type_unsigned_int}, {"count", indices}, {"type", "SCALAR"}}});
    json["bufferViews"] = Json::array(
        {{{"buffer", 0}, {"byteLength", vertex_bytes}, {"target", target_vertices}},
         {{"buffer", 0}, {"byteOffset", vertex_bytes}, {"byteLength", index_bytes}, {"target", target_indices}}});
    json["buffers"] = Json::array({{{"byteLength", vertex_bytes + index_bytes}}});
    return json;
}

void append_chunk(std::string& bytes, const char* type, const std::string& content) {
    append_little_endian(bytes, static_cast<std::uint32_t>(content.size()));
    bytes.append(type, 4);
    bytes += content;
}

} // namespace

std::string format_glb(const Points<double>& vertices, const Triangles& faces) {
    if (vertices.rows() == 0 || faces.rows() == 0) refuse("GLB has no way to write a mesh without faces");
    const Points<float> positions = vertices.cast<float>();
    if (!positions.allFinite()) refuse("a coordinate is too large for GLB; write OFF, OBJ or PLY");

    std::string data;
    for (const float coordinate : positions.reshaped<Eigen::RowMajor>()) append_little_endian(data, coordinate);
    for (const int corner : faces.reshaped<Eigen::RowMajor>())
        append_little_endian(data, static_cast<std::uint32_t>(corner));
    std::string json = describe(positions, static_cast<std::size_t>(faces.size())).dump();
    json.resize((json.size() + 3) / 4 * 4, ' '); // chunks are of whole words; the data's are already

    constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
    std::string bytes = "glTF";
    append_little_endian(bytes, std::uint32_t{2});
    append_little_endian(bytes,
                         static_cast<std::uint32_t>(header_bytes + 2 * chunk_header_bytes + json.size() + data.size()));
    append_chunk(bytes, "JSON", json);
    append_chunk(bytes, std::string("BIN\0", 4).c_str(), data);
    return bytes;
}

} // namespace skelgen::io::detail
