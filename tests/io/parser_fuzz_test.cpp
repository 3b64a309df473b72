#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/io/bvh.hpp>
#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/scene_looks.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "mesh_expectations.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;

namespace {

struct Sample {
    std::string name;
    std::string bytes;
    std::optional<MeshFormat> extension;
};

std::vector<Sample> samples() {
    const std::string rows = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
                      ply = "element vertex 4\nproperty float x\n"
                            "property float y\nproperty list uchar int more\nproperty float z\nelement face 2\n"
                            "property list uchar int vertex_indices\nend_header\n";
    std::string binary_off = "OFF BINARY\n";
    binary_off += std::string("\0\0\0\3\0\0\0\1\0\0\0\0", 12) + std::string(36, '\0'); // counts, three points
    binary_off += std::string("\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\0", 20);         // one triangle
    return {
        {"OFF", "COFF # c\n4 3 6\n" + rows + "3 0 2 1 255 0 0\n4 0 1 3 2\n3 1 2 3", std::nullopt},
        {"OFF without keyword", "4 2 6\n" + rows + "3 0 2 1\n4 0 1 3 2\n", MeshFormat::off},
        {"binary OFF", binary_off, std::nullopt},
        {"OBJ", "v 0 0 0\nv 1 0 0\nvn 0 0 1\nv 0 1 \\\n 0\nv 0 0 1 # c\nf 1/1/1 -2 2\nf 1 2// 4 3\n", MeshFormat::obj},
        {"text PLY",
         "ply\nformat ascii 1.0\ncomment c\n" + ply + "0 0 0 0\n1 0 1 5 0\n0 1 0 0\n0 0 0 1\n3 0 1 2\n4 0 1 2 3\n",
         std::nullopt},
        {"binary PLY", format_mesh(tetrahedron(), MeshFormat::ply), std::nullopt},
        {"text STL",
         "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
         "0\nendloop\nendfacet\nendsolid s\n",
         std::nullopt},
        {"binary STL", format_mesh(tetrahedron(), MeshFormat::stl), MeshFormat::stl},
        {"GLB", format_mesh(tetrahedron(), MeshFormat::glb), MeshFormat::glb},
    };
}

/// Whether `parse`, which looks at what came out, takes its input; if not, the input must be what is to blame.
template <typename Parse>
bool accepted_by(const Parse& parse) {
    try {
        parse();
        return true;
    } catch (const Error& error) {
        REQUIRE(error.code() == ErrorCode::bad_input);
        REQUIRE(std::string(error.what()).size() > 10);
        return false;
    }
}

/// What a mesh that is read looks like can be written with it, or is refused.
void check_looks(const std::string& bytes, std::optional<MeshFormat> extension, const TriangleMesh<double>& mesh) {
    try {
        const auto looks = parse_looks(bytes, {extension, "", 0});
        if (!looks || mesh.vertices.cwiseAbs().maxCoeff() > 1e30) return;
        Eigen::Index faces = 0;
        for (const ScenePart& part : looks->parts) faces += part.faces;
        REQUIRE(faces == mesh.faces.rows());
    } catch (const Error& error) {
        REQUIRE(error.code() == ErrorCode::bad_input);
    }
}

/// Whether a mesh came out; then it must be a sound one.
bool parses(const std::string& bytes, std::optional<MeshFormat> extension) {
    return accepted_by([&] {
        const TriangleMesh<double> mesh = parse_mesh(bytes, extension);
        REQUIRE(mesh.faces.rows() > 0);
        REQUIRE(mesh.vertices.allFinite());
        REQUIRE(mesh.faces.minCoeff() >= 0);
        REQUIRE(mesh.faces.maxCoeff() < mesh.vertices.rows());
        check_looks(bytes, extension, mesh);
    });
}

/// Has `parse` try the text with each of its bytes changed into each of those.
template <typename Parse>
void change_every_byte(const std::string& text, std::initializer_list<char> bytes, const Parse& parse) {
    for (std::size_t i = 0; i < text.size(); ++i)
        for (const char byte : bytes) {
            std::string changed = text;
            changed[i] = byte;
            static_cast<void>(parse(changed));
        }
}

/// One to three bytes changed, removed, doubled or swapped for ones that mean something to a parser.
std::string mutated(std::string bytes, std::mt19937& random) {
    static const std::string meaningful("-+.0129eE/# \n\r\t\\\"[]{},\0\x7f\x80\xff", 27);
    const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    for (std::size_t changes = 1 + below(3); changes > 0 && !bytes.empty(); --changes) {
        const std::size_t at = below(bytes.size());
        switch (below(5)) {
        case 0:
            bytes[at] = static_cast<char>(below(256));
            break;
        case 1:
            bytes[at] = meaningful[below(meaningful.size())];
            break;
        case 2:
            bytes.erase(at, 1 + below(4));
            break;
        case 3:
            bytes.insert(at, bytes.substr(at, 1 + below(20)));
            break;
        default:
            bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1U << below(8)));
            break;
        }
    }
    return bytes;
}

} // namespace

TEST_CASE("mesh parsers: files cut short at every byte", "[io][fuzz]") {
    for (const Sample& sample : samples()) {
        INFO(sample.name);
        REQUIRE(parses(sample.bytes, sample.extension));
        for (std::size_t size = 0; size < sample.bytes.size(); ++size)
            static_cast<void>(parses(sample.bytes.substr(0, size), sample.extension));
    }
}

TEST_CASE("mesh parsers: every byte of a file changed", "[io][fuzz]") {
    for (const Sample& sample : samples()) {
        INFO(sample.name);
        change_every_byte(sample.bytes, {'\0', '-', '9', ' ', '\n', '\x7f', '\xff'},
                          [&](const std::string& changed) { return parses(changed, sample.extension); });
    }
}

TEST_CASE("mesh parsers: random changes", "[io][fuzz]") {
    std::mt19937 random(2020);
    for (const Sample& sample : samples()) {
        INFO(sample.name);
        int refused = 0;
        for (int trial = 0; trial < 3000; ++trial) refused += !parses(mutated(sample.bytes, random), sample.extension);
        CHECK(refused > 100);
    }
}

TEST_CASE("mesh parsers: random bytes", "[io][fuzz]") {
    std::mt19937 random(2021);
    for (int trial = 0; trial < 500; ++trial) {
        std::string bytes(random() % 300, '\0');
        for (char& byte : bytes) byte = static_cast<char>(random() % 256);
        for (const auto format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply, MeshFormat::stl, MeshFormat::glb})
            static_cast<void>(parses(bytes, format));
    }
}

namespace {

struct CurveSample {
    std::string name;
    std::string bytes;
    CurveSkeleton<double> (*parse)(std::string_view);
};

std::vector<CurveSample> curve_samples() {
    CurveSkeleton<double> curve;
    curve.nodes.resize(4, 3);
    curve.nodes << 0, 0, 0, 1, 1e5, 0.25, 2, -1, 0, 1, 1, 1;
    curve.edges = {{0, 1}, {0, 2}, {1, 2}, {2, 3}};
    curve.radii = {1, 2, 0, 3.5};
    curve.regions = {{0, 1}, {}, {2}, {3}};
    std::string binary = "ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                         "property list uchar short more\nproperty float z\nelement edge 1\nproperty int vertex1\n"
                         "property uchar vertex2\nend_header\n";
    binary += std::string(8, '\0') + std::string("\1\0\0", 3) + std::string(4, '\0'); // a node with a list of one
    binary += std::string(8, '\0') + std::string("\0", 1) + std::string(4, '\1');     // another, of none
    binary += std::string("\0\0\0\0\1", 5);                                           // the edge between them
    return {{"JSON", curve_to_json(curve), curve_from_json<double>},
            {"OBJ", curve_to_obj(curve) + "l -1 2\n", curve_from_obj<double>},
            {"PLY", curve_to_ply(curve), curve_from_ply<double>},
            {"binary PLY", binary, curve_from_ply<double>},
            {"SWC", curve_to_swc(curve), curve_from_swc<double>}};
}

/// Whether a curve came out; then it must be a sound one.
bool parses_curve(const std::string& bytes, const CurveSample& sample) {
    return accepted_by([&] {
        const CurveSkeleton<double> read = sample.parse(bytes);
        REQUIRE(read.nodes.rows() > 0);
        REQUIRE(read.nodes.allFinite());
        for (const auto& [a, b] : read.edges) REQUIRE((0 <= a && a < b && b < read.nodes.rows()));
        REQUIRE(std::is_sorted(read.edges.begin(), read.edges.end()));
        REQUIRE((read.radii.empty() || static_cast<Eigen::Index>(read.radii.size()) == read.nodes.rows()));
    });
}

} // namespace

TEST_CASE("curve parsers: cut short at every byte, and every byte changed", "[io][fuzz]") {
    for (const CurveSample& sample : curve_samples()) {
        INFO(sample.name);
        REQUIRE(parses_curve(sample.bytes, sample));
        for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
            const bool parsed = parses_curve(sample.bytes.substr(0, size), sample);
            if (sample.name == "JSON" && size + 2 < sample.bytes.size()) CHECK_FALSE(parsed);
        }
        change_every_byte(sample.bytes, {'\0', '-', '9', ' ', '\n', '#', '\x7f', '\xff'},
                          [&](const std::string& changed) { return parses_curve(changed, sample); });
    }
}

TEST_CASE("curve parsers: random changes and random bytes", "[io][fuzz]") {
    std::mt19937 random(2022);
    for (const CurveSample& sample : curve_samples()) {
        INFO(sample.name);
        int refused = 0;
        for (int trial = 0; trial < 2000; ++trial) refused += !parses_curve(mutated(sample.bytes, random), sample);
        CHECK(refused > 100);
        for (int trial = 0; trial < 200; ++trial) {
            std::string bytes(random() % 300, '\0');
            for (char& byte : bytes) byte = static_cast<char>(random() % 256);
            static_cast<void>(parses_curve(bytes, sample));
        }
    }
    const CurveSample json = curve_samples().front();
    CHECK_FALSE(
        parses_curve(R"({"format": "skelgen-curve", "version": 1, "nodes": [[1e999, 0, 0]], "edges": []})", json));
    CHECK_FALSE(parses_curve(R"({"format": "skelgen-curve\xff", "version": 1})", json));
}

namespace {

/// Whether a clip came out; then it must be a sound one.
bool parses_clip(const std::string& bytes) {
    return accepted_by([&] {
        const auto clip = parse_bvh(bytes);
        REQUIRE(clip.frames.rows() > 0);
        REQUIRE(clip.frames.allFinite());
        REQUIRE(pose_in(clip, 0).positions.size() == clip.joints.size());
        for (std::size_t j = 0; j < clip.joints.size(); ++j) REQUIRE(clip.joints[j].parent < static_cast<int>(j));
    });
}

} // namespace

TEST_CASE("BVH parser: cut short, every byte changed, random changes", "[io][fuzz]") {
    const std::string clip = "HIERARCHY\nROOT a b\n{\n OFFSET 1 2 3\n CHANNELS 2 Yrotation Xposition\n JOINT c{\n"
                             "  OFFSET 0 0 1\n  CHANNELS 1 Zrotation\n  End Site\n  {\n   OFFSET 0 0 1\n  }\n }\n}\n"
                             "MOTION\nFrames: 2\nFrame Time: 0.04\n1 2 3\n4 5 6\n";
    REQUIRE(parses_clip(clip));
    for (std::size_t size = 0; size + 2 < clip.size(); ++size) CHECK_FALSE(parses_clip(clip.substr(0, size)));
    change_every_byte(clip, {'\0', '-', '9', ' ', '\n', '}', '\x7f', '\xff'}, parses_clip);
    std::mt19937 random(2023);
    int refused = 0;
    for (int trial = 0; trial < 3000; ++trial) refused += !parses_clip(mutated(clip, random));
    CHECK(refused > 100);
}
