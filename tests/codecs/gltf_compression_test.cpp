#include <fstream>
#include <string>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/scene_looks.hpp>

#include "catch.hpp"
#include "io/gltf_builder.hpp"
#include "io/mesh_expectations.hpp"
#include "temporary_folder.hpp"

#if SKELGEN_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif
#if SKELGEN_WITH_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;

namespace {

/// A file whose every byte in turn is changed, and which is cut short at every byte, is read or refused: nothing else.
[[maybe_unused]] void check_damaged(const std::string& bytes) {
    const auto survives = [](const std::string& damaged) {
        try {
            const auto mesh = parse_mesh(damaged);
            CHECK(mesh.faces.maxCoeff() < mesh.vertices.rows());
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::bad_input);
        }
    };
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        survives(bytes.substr(0, i));
        for (const char byte : {'\0', '\x7f', '\xff'}) {
            std::string changed = bytes;
            changed[i] = byte;
            survives(changed);
        }
    }
}

} // namespace

#if SKELGEN_WITH_MESHOPTIMIZER

namespace {

using Json = GltfBuilder::Json;

std::string encoded_vertices(const std::string& rows, std::size_t count, std::size_t stride) {
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), rows.data(),
                                            count, stride));
    return bytes;
}

std::string encoded_triangles(const std::vector<unsigned>& indices, std::size_t vertices) {
    std::string bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), indices.data(),
                                           indices.size()));
    return bytes;
}

std::string encoded_sequence(const std::vector<unsigned>& indices, std::size_t vertices) {
    std::string bytes(meshopt_encodeIndexSequenceBound(indices.size(), vertices), '\0');
    bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                             indices.data(), indices.size()));
    return bytes;
}

/// Lets view `view` be the compressed part that view `compressed` holds; the buffer it names itself is not there.
void compress(GltfBuilder& scene, std::size_t view, std::size_t compressed, std::size_t count, std::size_t stride,
              const char* mode, const char* filter = "NONE") {
    const Json part = scene.json["bufferViews"][compressed];
    scene.json["bufferViews"][view] = {{"buffer", 1},
                                       {"byteLength", count * stride},
                                       {"extensions",
                                        {{"EXT_meshopt_compression",
                                          {{"buffer", 0},
                                           {"byteOffset", part["byteOffset"]},
                                           {"byteLength", part["byteLength"]},
                                           {"byteStride", stride},
                                           {"count", count},
                                           {"mode", mode},
                                           {"filter", filter}}}}}};
}

GltfBuilder compressed_tetrahedron() {
    GltfBuilder scene;
    scene.add_tetrahedron();
    const std::string positions = GltfBuilder::raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    scene.bytes.clear();
    scene.json["bufferViews"] = Json::array({Json(), Json()});
    const auto vertices = scene.add_view(encoded_vertices(positions, 4, 12));
    const auto triangles = scene.add_view(encoded_triangles({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, 4));
    compress(scene, 0, vertices, 4, 12, "ATTRIBUTES");
    compress(scene, 1, triangles, 12, 2, "TRIANGLES");
    scene.json["buffers"].push_back(
        {{"byteLength", 72}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    scene.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    return scene;
}

} // namespace

TEST_CASE("meshopt: vertices and triangles", "[codecs][meshopt]") {
    const auto mesh = parse_mesh(compressed_tetrahedron().glb());
    CHECK(mesh.vertices == tetrahedron().vertices);
    REQUIRE(mesh.faces.rows() == 4); // each begins where the encoder likes
    for (int i = 0; i < 4; ++i) {
        const Eigen::RowVector3i face = mesh.faces.row(i), expected = tetrahedron().faces.row(i);
        const bool same = face == expected || face == Eigen::RowVector3i(expected[1], expected[2], expected[0]) ||
                          face == Eigen::RowVector3i(expected[2], expected[0], expected[1]);
        CHECK(same);
    }
}

TEST_CASE("meshopt: index sequences and the exponential filter", "[codecs][meshopt]") {
    GltfBuilder scene = compressed_tetrahedron();
    const auto strip = scene.add_view(encoded_sequence({0, 1, 2, 3}, 4));
    compress(scene, 1, strip, 4, 4, "INDICES");
    scene.json["accessors"][1]["count"] = 4;
    scene.json["accessors"][1]["componentType"] = 5125;
    scene.primitive()["mode"] = 5;
    // Exponents in the upper 8 bits, mantissas below: 3 = 3 x 2^0, 5/2 = 5 x 2^-1.
    const auto filtered = scene.add_view(
        encoded_vertices(GltfBuilder::raw<std::uint32_t>({3, 0xFF000005, 0, 0, 0, 0, 0, 3, 0, 0, 0, 3}), 4, 12));
    compress(scene, 0, filtered, 4, 12, "ATTRIBUTES", "EXPONENTIAL");
    const auto mesh = parse_mesh(scene.glb());
    CHECK(mesh.vertices.row(0) == Eigen::RowVector3d(3, 2.5, 0));
    CHECK(mesh.vertices.row(3) == Eigen::RowVector3d(0, 0, 3));
    CHECK(mesh.faces == (Triangles(2, 3) << 0, 1, 2, 1, 3, 2).finished());
}

TEST_CASE("meshopt: damaged and lying parts", "[codecs][meshopt]") {
    check_damaged(compressed_tetrahedron().glb());
    for (const auto& [key, value] : std::vector<std::pair<const char*, Json>>{{"count", 1099511627776},
                                                                              {"count", 100000},
                                                                              {"byteStride", 0},
                                                                              {"byteStride", 7},
                                                                              {"byteStride", 1099511627776},
                                                                              {"mode", "TRIANGLES"},
                                                                              {"mode", "NONSENSE"},
                                                                              {"filter", "QUATERNION"},
                                                                              {"filter", "NONSENSE"},
                                                                              {"byteLength", 3},
                                                                              {"buffer", 1}}) {
        GltfBuilder scene = compressed_tetrahedron();
        scene.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
        INFO(key << " " << value);
        CHECK_THAT(reading_error(scene.glb()), Catch::Matchers::StartsWith("glTF: "));
    }
}

#endif

#if SKELGEN_WITH_DRACO

namespace {

/// The tetrahedron compressed by Draco, with joints, weights and colours: each vertex that of its place.
std::string draco_scene() {
    draco::TriangleSoupMeshBuilder builder;
    const auto mesh = tetrahedron();
    builder.Start(static_cast<int>(mesh.faces.rows()));
    const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int joints = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
    const int weights = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
    const int colours = builder.AddAttribute(draco::GeometryAttribute::COLOR, 3, draco::DT_FLOAT32);
    for (int face = 0; face < mesh.faces.rows(); ++face) {
        std::vector<std::array<float, 3>> corners;
        for (int k = 0; k < 3; ++k) {
            const Eigen::RowVector3f corner = mesh.vertices.row(mesh.faces(face, k)).cast<float>();
            corners.push_back({corner[0], corner[1], corner[2]});
        }
        builder.SetAttributeValuesForFace(positions, draco::FaceIndex(static_cast<std::uint32_t>(face)),
                                          corners[0].data(), corners[1].data(), corners[2].data());
        builder.SetAttributeValuesForFace(colours, draco::FaceIndex(static_cast<std::uint32_t>(face)),
                                          corners[0].data(), corners[1].data(), corners[2].data());
        const std::array<std::uint8_t, 4> joint{1, 0, 0, 0};
        const std::array<float, 4> weight{1, 0, 0, 0};
        builder.SetAttributeValuesForFace(joints, draco::FaceIndex(static_cast<std::uint32_t>(face)), joint.data(),
                                          joint.data(), joint.data());
        builder.SetAttributeValuesForFace(weights, draco::FaceIndex(static_cast<std::uint32_t>(face)), weight.data(),
                                          weight.data(), weight.data());
    }
    const auto soup = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING); // keeps the order
    draco::EncoderBuffer buffer;
    REQUIRE(encoder.EncodeMeshToBuffer(*soup, &buffer).ok());

    GltfBuilder scene;
    scene.add_tetrahedron();
    scene.bytes.clear();
    scene.json["bufferViews"].clear();
    for (auto& accessor : scene.json["accessors"]) accessor.erase("bufferView");
    const auto view = scene.add_view(std::string(buffer.data(), buffer.size()));
    scene.primitive()["attributes"]["JOINTS_0"] = 0;
    scene.primitive()["attributes"]["WEIGHTS_0"] = 0;
    scene.primitive()["attributes"]["COLOR_0"] = 0;
    scene.primitive()["extensions"] = {
        {"KHR_draco_mesh_compression",
         {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"JOINTS_0", 1}, {"WEIGHTS_0", 2}, {"COLOR_0", 3}}}}}};
    scene.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    scene.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"translation", {0, 0, 0}}}, {{"translation", {0, 0, 10}}}};
    scene.json["skins"] = {{{"joints", {1, 2}}}};
    return scene.glb();
}

} // namespace

TEST_CASE("Draco: positions, joints, weights and triangles", "[codecs][draco]") {
    const auto mesh = parse_mesh(draco_scene());
    REQUIRE(mesh.vertices.rows() == 4);
    REQUIRE(mesh.faces.rows() == 4);
    const TriangleMesh<double> expected = tetrahedron();
    for (int face = 0; face < 4; ++face)
        for (int k = 0; k < 3; ++k)
            CHECK((mesh.vertices.row(mesh.faces(face, k)) - expected.vertices.row(expected.faces(face, k)) -
                   Eigen::RowVector3d(0, 0, 10))
                      .norm() < 1e-6);
}

TEST_CASE("Draco: colours", "[codecs][draco]") {
    const TemporaryFolder folder;
    std::ofstream(folder / "scene.glb", std::ios::binary) << draco_scene();
    const auto looks = read_looks(folder / "scene.glb");
    REQUIRE(looks);
    REQUIRE(looks->parts.size() == 1);
    const auto mesh = read_mesh(folder / "scene.glb");
    REQUIRE(looks->parts[0].colours.rows() == mesh.vertices.rows());
    for (int v = 0; v < 4; ++v) {
        const Eigen::RowVector3f place = (mesh.vertices.row(v) - Eigen::RowVector3d(0, 0, 10)).cast<float>();
        CHECK((looks->parts[0].colours.row(v).head<3>() - place).norm() < 1e-6F);
        CHECK(looks->parts[0].colours(v, 3) == 1);
    }
}

TEST_CASE("Draco: damaged parts", "[codecs][draco]") { check_damaged(draco_scene()); }

#endif
