#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <skelgen/core/mesh.hpp>

namespace skelgen::test {

/// Makes small glTF files: rows of numbers go into one buffer, and the JSON around them is open to any change.
class GltfBuilder {
public:
    using Json = nlohmann::json;
    Json json{{"asset", {{"version", "2.0"}}}, {"scene", 0},
              {"scenes", {{{"nodes", {0}}}}},  {"nodes", Json::array({{{"mesh", 0}}})},
              {"meshes", Json::array()},       {"accessors", Json::array()},
              {"bufferViews", Json::array()},  {"buffers", {{{"byteLength", 0}}}}};
    std::string bytes;

    /// Adds a view of raw bytes; gives its number.
    std::size_t add_view(std::string_view content) {
        while (bytes.size() % 4 != 0) bytes += '\0';
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}});
        bytes += content;
        return json["bufferViews"].size() - 1;
    }

    /// Adds an accessor of numbers of type T; gives its number.
    template <typename T>
    std::size_t add(const std::string& type, const std::vector<T>& values) {
        const std::size_t view = add_view(raw(values));
        json["accessors"].push_back({{"bufferView", view},
                                     {"componentType", component_type<T>()},
                                     {"count", values.size() / columns(type)},
                                     {"type", type}});
        return json["accessors"].size() - 1;
    }

    /// The bytes that numbers have in memory, which is as glTF has them on the machines that run this.
    template <typename T>
    static std::string raw(const std::vector<T>& values) {
        return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
    }

    /// Adds what a primitive of a mesh's places and faces refers to; gives that primitive.
    Json primitive_of(const TriangleMesh<double>& mesh) {
        const TriangleMesh<float> single{mesh.vertices.cast<float>(), mesh.faces};
        const std::size_t positions =
            add<float>("VEC3", {single.vertices.data(), single.vertices.data() + single.vertices.size()});
        const std::size_t indices =
            add<std::uint32_t>("SCALAR", {mesh.faces.data(), mesh.faces.data() + mesh.faces.size()});
        return {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
    }

    /// A mesh as the only primitive.
    void add_mesh(const TriangleMesh<double>& mesh) {
        json["meshes"].push_back({{"primitives", Json::array({primitive_of(mesh)})}});
    }

    /// The tetrahedron of the origin and the unit vectors as a mesh's only primitive.
    void add_tetrahedron() {
        const std::size_t positions = add<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
        const std::size_t indices = add<std::uint16_t>("SCALAR", {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
        json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}});
    }

    [[nodiscard]] Json& primitive() { return json["meshes"][0]["primitives"][0]; }

    /// The file as GLB.
    [[nodiscard]] std::string glb() const {
        Json complete = json;
        std::string binary = bytes;
        while (binary.size() % 4 != 0) binary += '\0';
        complete["buffers"][0]["byteLength"] = bytes.size();
        std::string text = complete.dump();
        while (text.size() % 4 != 0) text += ' ';
        const auto word = [](std::size_t value) { return raw<std::uint32_t>({static_cast<std::uint32_t>(value)}); };
        return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + binary.size()) + word(text.size()) + "JSON" + text +
               word(binary.size()) + std::string("BIN\0", 4) + binary;
    }

    /// The file's JSON, its buffer under this name.
    [[nodiscard]] std::string gltf(const std::string& uri) const {
        Json complete = json;
        complete["buffers"][0]["byteLength"] = bytes.size();
        complete["buffers"][0]["uri"] = uri;
        return complete.dump();
    }

    /// The file's buffer within its JSON.
    [[nodiscard]] std::string data_uri() const { return "data:application/octet-stream;base64," + base64(bytes); }

private:
    template <typename T>
    static int component_type() {
        if (std::is_same_v<T, float>) return 5126;
        return 5120 + (sizeof(T) == 4 ? 4 : sizeof(T) == 2 ? 2 : 0) + (std::is_unsigned_v<T> ? 1 : 0);
    }

    static std::size_t columns(const std::string& type) {
        if (type == "SCALAR") return 1;
        return type == "MAT4" ? 16 : static_cast<std::size_t>(type.back() - '0');
    }

    static std::string base64(const std::string& content) {
        const char* const alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t i = 0; i < content.size(); i += 3) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 3; ++k)
                bits = bits << 8U | (i + k < content.size() ? static_cast<unsigned char>(content[i + k]) : 0U);
            for (std::size_t k = 0; k < 4; ++k)
                text += i + k <= content.size() ? alphabet[bits >> (18 - 6 * k) & 63U] : '=';
        }
        return text;
    }
};

} // namespace skelgen::test
