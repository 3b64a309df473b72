#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <zlib.h>

#include <skelgen/applications/animation.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/io/scene_looks.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "applications/template_rig.hpp"
#include "catch.hpp"
#include "io/gltf_builder.hpp"
#include "shapes.hpp"

#if SKELGEN_WITH_ZLIB

namespace {

using namespace skelgen;
using namespace std::string_literals;
using applications::Animation;
using applications::Rig;
using test::GltfBuilder;

/// A node of an FBX document as it is read: texts and bytes as they are, numbers and lists of them as doubles.
struct Node {
    std::vector<std::string> texts;
    std::vector<std::vector<double>> numbers;
    std::vector<std::pair<std::string, Node>> children;

    [[nodiscard]] std::vector<const Node*> all(const std::string& name) const {
        std::vector<const Node*> out;
        for (const auto& [key, child] : children)
            if (key == name) out.push_back(&child);
        return out;
    }
    [[nodiscard]] const Node& at(const std::string& name) const {
        const auto found = all(name);
        REQUIRE(found.size() == 1);
        return *found.front();
    }
    /// The objects of a kind whose last text is `subtype`.
    [[nodiscard]] std::vector<const Node*> objects(const std::string& kind, const std::string& subtype) const {
        std::vector<const Node*> out;
        for (const Node* one : at("Objects").all(kind))
            if (one->texts.back() == subtype) out.push_back(one);
        return out;
    }
    /// The values of a property in "Properties70".
    [[nodiscard]] std::vector<double> property(const std::string& name) const {
        std::vector<double> out;
        for (const Node* one : at("Properties70").all("P"))
            if (one->texts.front() == name)
                for (const auto& values : one->numbers) out.push_back(values.at(0));
        return out;
    }
};

/// Reads documents of 32-bit places, and fails where lengths and places do not agree.
class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    Node document() {
        REQUIRE(bytes_.substr(0, 23) == "Kaydara FBX Binary  \0\x1a\0"s);
        at_ = 23;
        REQUIRE(number<std::uint32_t>() == 7400);
        Node out;
        read_children(out, bytes_.size());
        return out;
    }
    [[nodiscard]] std::string_view rest() const { return bytes_.substr(at_); }

private:
    template <typename Number>
    Number number() {
        Number out;
        REQUIRE(at_ + sizeof(out) <= bytes_.size());
        std::memcpy(&out, bytes_.data() + at_, sizeof(out));
        at_ += sizeof(out);
        return out;
    }
    std::string take(std::size_t length) {
        REQUIRE(at_ + length <= bytes_.size());
        at_ += length;
        return std::string(bytes_.substr(at_ - length, length));
    }
    template <typename Number>
    std::vector<double> list() {
        const auto length = number<std::uint32_t>(), encoding = number<std::uint32_t>();
        const std::string stored = take(number<std::uint32_t>());
        REQUIRE(encoding == 1);
        std::vector<Number> values(length + 1);
        uLongf size = length * sizeof(Number);
        REQUIRE(::uncompress(reinterpret_cast<Bytef*>(values.data()), &size,
                             reinterpret_cast<const Bytef*>(stored.data()), stored.size()) == Z_OK);
        REQUIRE(size == length * sizeof(Number));
        return {values.begin(), values.end() - 1};
    }
    void read_children(Node& parent, std::size_t end) {
        while (true) {
            REQUIRE(at_ < end);
            const auto stop = number<std::uint32_t>(), count = number<std::uint32_t>(), bytes = number<std::uint32_t>();
            const std::string name = take(number<std::uint8_t>());
            if (stop == 0) return;
            REQUIRE(stop <= end);
            Node node;
            const std::size_t begin = at_;
            for (std::uint32_t i = 0; i < count; ++i) read_property(node);
            REQUIRE(at_ == begin + bytes);
            if (at_ < stop) read_children(node, stop);
            REQUIRE(at_ == stop);
            parent.children.emplace_back(name, std::move(node));
        }
    }
    void read_property(Node& node) {
        switch (number<char>()) {
        case 'C':
            return node.numbers.push_back({static_cast<double>(number<char>())});
        case 'I':
            return node.numbers.push_back({static_cast<double>(number<std::int32_t>())});
        case 'L':
            return node.numbers.push_back({static_cast<double>(number<std::int64_t>())});
        case 'D':
            return node.numbers.push_back({number<double>()});
        case 'S':
        case 'R':
            return node.texts.push_back(take(number<std::uint32_t>()));
        case 'i':
            return node.numbers.push_back(list<std::int32_t>());
        case 'l':
            return node.numbers.push_back(list<std::int64_t>());
        case 'd':
            return node.numbers.push_back(list<double>());
        case 'f':
            return node.numbers.push_back(list<float>());
        default:
            FAIL("a property of no known type");
        }
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
};

/// A mesh with joints of human21 in its rest pose, moved by the root and the chest.
Rig<double> rig_of(const TriangleMesh<double>& mesh) {
    Rig<double> rig;
    rig.mesh = mesh;
    rig.unit_is_known = true;
    rig.joints = test::template_joints();
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(mesh.vertices.rows(), 21);
    weights.col(0).setConstant(0.25);
    weights.col(2).setConstant(0.75);
    rig.skin = applications::strongest_influences<double>(weights);
    rig.turns.resize(static_cast<std::size_t>(mesh.vertices.rows()), Eigen::Quaterniond::Identity());
    return rig;
}

/// All joints turn on and on, by more than half a turn, and the root moves.
Animation<double> turning(const Rig<double>& rig) {
    Animation<double> out{"turning", 1.0 / 25, {}};
    for (int i = 0; i < 20; ++i) {
        applications::RigPose<double> pose{Eigen::Vector3d(0.1 * i, 1, -0.05 * i), {}};
        for (std::size_t j = 0; j < rig.joints.size(); ++j)
            pose.axes.push_back(rig.joints[j].axes *
                                Eigen::AngleAxisd(0.3 * i + 0.1 * static_cast<double>(j),
                                                  Eigen::Vector3d(1, 2 + static_cast<double>(j), -1).normalized()));
        out.frames.push_back(std::move(pose));
    }
    return out;
}

/// A tetrahedron with all that looks and morph targets can have.
GltfBuilder scene_with_looks() {
    GltfBuilder scene;
    scene.add_tetrahedron();
    GltfBuilder::Json& mesh = scene.json["meshes"][0];
    GltfBuilder::Json& primitive = mesh["primitives"][0];
    primitive["attributes"]["NORMAL"] = scene.add<float>("VEC3", {0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 1});
    primitive["attributes"]["TEXCOORD_0"] = scene.add<float>("VEC2", {0, 0, 0.5F, 0.25F, 1, 0, 1, 1});
    primitive["attributes"]["TEXCOORD_1"] = scene.add<float>("VEC2", {1, 1, 0, 0, 0, 0, 0, 0.75F});
    primitive["attributes"]["COLOR_0"] = scene.add<float>("VEC4", {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0.5F, 1, 1, 1, 1});
    primitive["material"] = 0;
    primitive["targets"] = {{{"POSITION", scene.add<float>("VEC3", {0, 0, 0, 0, 0, 0.5F, 0, 0, 0, 0, 0, 0})}},
                            {{"POSITION", scene.add<float>("VEC3", std::vector<float>(12, 0))}}};
    mesh["weights"] = {0.5, 0.0};
    mesh["extras"] = {{"targetNames", {"smile", "nothing"}}};
    mesh["name"] = "face mesh";
    scene.json["nodes"][0]["name"] = "Face";
    scene.json["nodes"][0]["extras"] = {{"layer", 3}, {"maker", "somebody"}};
    scene.json["materials"] = {{{"name", "skin"},
                                {"alphaMode", "BLEND"},
                                {"emissiveFactor", {0.5, 0, 0}},
                                {"normalTexture", {{"index", 1}}},
                                {"pbrMetallicRoughness",
                                 {{"baseColorFactor", {0.5, 1, 1, 0.25}},
                                  {"roughnessFactor", 0.5},
                                  {"metallicFactor", 0.75},
                                  {"baseColorTexture", {{"index", 0}, {"texCoord", 1}}},
                                  {"metallicRoughnessTexture", {{"index", 2}}}}}}};
    scene.json["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
    for (const char* last : {"AA==", "AQ==", "Ag=="}) // behind the first bytes of a PNG
        scene.json["images"].push_back({{"uri", "data:image/png;base64,iVBORw0KGgo"s + last}});
    scene.json["asset"]["extras"] = {{"title", "Ada"}, {"author", "A. Maker"}, {"license", "CC0"}};
    return scene;
}

TEST_CASE("FBX: a document that is whole, with the foot that goes with its identity", "[codecs][fbx]") {
    const auto rig = rig_of(test::box({0.2, 1.7, 0.3}, 2));
    const std::string fbx = io::rig_to_fbx(rig, io::JointNames::mixamo, {}, {turning(rig)});
    Reader reader(fbx);
    const Node document = reader.document();
    const std::size_t foot = fbx.size() - 140; // the version once more, zeros, and 16 bytes that all files end with
    CHECK(foot % 16 == 0);
    CHECK(fbx.substr(foot, 4) == "\xe8\x1c\0\0"s);
    CHECK(reader.rest().substr(0, 4) == "\xfa\xbc\xab\x09"s);
    CHECK(reader.rest().substr(reader.rest().size() - 4) == "\x75\x8f\x29\x0b"s);
    CHECK(document.at("FileId").texts.front().size() == 16);
    CHECK(document.at("GlobalSettings").property("UnitScaleFactor") == std::vector<double>{1});
    CHECK(document.at("GlobalSettings").property("UpAxis") == std::vector<double>{1});
    CHECK(document.at("GlobalSettings").property("CustomFrameRate") == std::vector<double>{25});

    // As many of each kind as is said.
    std::map<std::string, double> said, there;
    for (const Node* type : document.at("Definitions").all("ObjectType"))
        said[type->texts.front()] = type->at("Count").numbers.at(0).at(0);
    for (const auto& [kind, object] : document.at("Objects").children) ++there[kind];
    said.erase("GlobalSettings");
    CHECK(said == there);
    CHECK(document.objects("Model", "LimbNode").size() == 21);
    CHECK(document.objects("Model", "LimbNode").front()->texts.front() == "Hips\0\1Model"s);
    CHECK(document.objects("Deformer", "Cluster").size() == 21);
    CHECK(document.at("Objects").at("Pose").all("PoseNode").size() == 22);
    CHECK(document.at("Objects").all("AnimationCurve").size() == 3 * 22);

    // Nothing is connected to what is not there.
    std::vector<double> ids{0};
    for (const auto& [kind, object] : document.at("Objects").children) ids.push_back(object.numbers.at(0).at(0));
    for (const Node* connection : document.at("Connections").all("C"))
        for (const std::size_t end : {0U, 1U})
            CHECK(std::find(ids.begin(), ids.end(), connection->numbers.at(end).at(0)) != ids.end());
    // Neighbouring frames have neighbouring angles: what is between them is, too.
    for (const Node* curve : document.at("Objects").all("AnimationCurve")) {
        const std::vector<double>& values = curve->at("KeyValueFloat").numbers.at(0);
        REQUIRE(values.size() == 20);
        for (std::size_t i = 1; i < values.size(); ++i) CHECK(std::abs(values[i] - values[i - 1]) < 181);
    }
    const std::vector<double>& times =
        document.at("Objects").all("AnimationCurve").front()->at("KeyTime").numbers.at(0);
    CHECK(times.at(10) == 0.4 * 46186158000);
}

TEST_CASE("FBX: looks, morph targets, custom properties and credits", "[codecs][fbx]") {
    const std::string glb = scene_with_looks().glb();
    const auto looks = io::parse_looks(glb);
    REQUIRE(looks);
    Rig<double> rig = rig_of(io::parse_mesh<double>(glb));
    rig.unit_is_known = false;
    const Node document = Reader(io::rig_to_fbx(rig, io::JointNames::skelgen, *looks)).document();
    CHECK(document.at("GlobalSettings").property("UnitScaleFactor") == std::vector<double>{100});
    const Node& mesh = *document.objects("Geometry", "Mesh").at(0);
    CHECK(mesh.texts.front() == "face mesh\0\1Geometry"s);
    CHECK(mesh.at("PolygonVertexIndex").numbers.at(0) == std::vector<double>{0, 2, -2, 0, 1, -4, 0, 3, -3, 1, 2, -4});
    CHECK(mesh.at("Vertices").numbers.at(0).at(5) == 0); // without the morph target that the file shows
    REQUIRE(mesh.all("LayerElementUV").size() == 2);
    const Node& second = *mesh.all("LayerElementUV").at(1);
    CHECK(second.at("Name").texts.front() == "UVMap1");
    CHECK(second.at("UV").numbers.at(0) == std::vector<double>{1, 0, 0, 1, 0, 1, 0, 0.25}); // counted upwards
    CHECK(second.at("UVIndex").numbers.at(0) == std::vector<double>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
    CHECK(mesh.at("LayerElementColor").at("Colors").numbers.at(0).at(11) == 0.5);
    CHECK(mesh.all("Layer").size() == 2);

    const Node& material = document.at("Objects").at("Material");
    CHECK(material.texts.front() == "skin\0\1Material"s);
    CHECK(material.property("DiffuseColor").at(0) == Approx(0.735357)); // as sRGB shows a half
    CHECK(material.property("EmissiveColor").at(0) == Approx(0.735357));
    CHECK(material.property("Opacity") == std::vector<double>{0.25});
    CHECK(material.property("Shininess") == std::vector<double>{25});
    CHECK(material.property("ReflectionFactor") == std::vector<double>{0.75});
    std::vector<std::string> pictures;
    for (const Node* video : document.at("Objects").all("Video"))
        pictures.push_back(video->at("Content").texts.front());
    CHECK(pictures == std::vector<std::string>{looks->pictures.at(0), looks->pictures.at(1)});
    std::vector<std::string> uses;
    for (const Node* connection : document.at("Connections").all("C"))
        if (connection->texts.front() == "OP") uses.push_back(connection->texts.back());
    CHECK(uses.size() == 3);
    CHECK(std::count(uses.begin(), uses.end(), "DiffuseColor") == 1);
    CHECK(std::count(uses.begin(), uses.end(), "TransparentColor") == 1);
    CHECK(std::count(uses.begin(), uses.end(), "NormalMap") == 1);

    const auto channels = document.objects("Deformer", "BlendShapeChannel");
    REQUIRE(channels.size() == 2);
    CHECK(channels[0]->texts.front() == "smile\0\1SubDeformer"s);
    CHECK(channels[0]->property("DeformPercent") == std::vector<double>{50});
    const auto shapes = document.objects("Geometry", "Shape");
    CHECK(shapes[0]->at("Indexes").numbers.at(0) == std::vector<double>{1});
    CHECK(shapes[0]->at("Vertices").numbers.at(0) == std::vector<double>{0, 0, 0.5});
    // One that moves nothing has a point that stays, as Blender 3 reads none without.
    CHECK(shapes[1]->at("Indexes").numbers.at(0) == std::vector<double>{0});
    CHECK(shapes[1]->at("Vertices").numbers.at(0) == std::vector<double>{0, 0, 0});

    const Node& face = *document.objects("Model", "Mesh").at(0);
    CHECK(face.texts.front() == "Face\0\1Model"s);
    CHECK(face.property("layer") == std::vector<double>{3});
    const Node& meta = document.at("FBXHeaderExtension").at("SceneInfo").at("MetaData");
    CHECK(meta.at("Title").texts.front() == "Ada");
    CHECK(meta.at("Author").texts.front() == "A. Maker");
    CHECK(meta.at("Comment").texts.front() == "CC0");
    CHECK(io::left_out_of(io::RigFormat::fbx, *looks) ==
          std::vector<std::string>{"1 pictures of roughness, metalness or shade (FBX has none; .glb)"});
    CHECK(io::left_out_of(io::RigFormat::glb, *looks).empty());
}

TEST_CASE("FBX: vertices that look different at one place are one there, with the weights of one", "[codecs][fbx]") {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
                            "f 1/1 3/3 2/2\nf 1/4 2/2 4/4\nf 1/2 4/4 3/3\nf 2/1 3/2 4/3\n";
    const auto looks = io::parse_looks(obj);
    REQUIRE(looks);
    REQUIRE_FALSE(looks->copies.empty());
    const Rig<double> rig = rig_of(io::parse_mesh<double>(obj));
    const Node document = Reader(io::rig_to_fbx(rig, io::JointNames::skelgen, *looks)).document();
    const Node& mesh = *document.objects("Geometry", "Mesh").at(0);
    CHECK(mesh.at("Vertices").numbers.at(0).size() == 12);
    CHECK(mesh.at("PolygonVertexIndex").numbers.at(0) == std::vector<double>{0, 2, -2, 0, 1, -4, 0, 3, -3, 1, 2, -4});
    const Node& layer = mesh.at("LayerElementUV");
    const auto& rows = layer.at("UV").numbers.at(0);
    const auto& corners = layer.at("UVIndex").numbers.at(0);
    const auto first = static_cast<std::size_t>(2 * corners.at(3)); // of the second triangle
    CHECK(rows.at(first) == 1);
    CHECK(rows.at(first + 1) == 1);
    for (const Node* cluster : document.objects("Deformer", "Cluster"))
        if (!cluster->all("Indexes").empty())
            CHECK(cluster->at("Indexes").numbers.at(0) == std::vector<double>{0, 1, 2, 3});
}

#if SKELGEN_WITH_ASSIMP

TEST_CASE("FBX: read back the mesh is where it was, and an animation takes it where the rig's poses do",
          "[codecs][fbx]") {
    auto rig = rig_of(test::box({0.2, 1.7, 0.3}, 2));
    const bool share_a_name = GENERATE(false, true); // the bone that moves most of the box, and another one
    if (share_a_name) rig.joints[2].name = rig.joints[1].name;
    const Animation<double> animation = turning(rig);
    const std::string fbx = io::rig_to_fbx(rig, io::JointNames::skelgen, {}, {animation});
    const auto corners = [&](const TriangleMesh<double>& mesh) {
        Points<double> out(mesh.faces.size(), 3);
        for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) out.row(i) = mesh.vertices.row(mesh.faces.data()[i]);
        return out;
    };
    const auto distance = [&](const TriangleMesh<double>& one, const TriangleMesh<double>& other) {
        REQUIRE(one.faces.rows() == other.faces.rows());
        return (corners(one) - 100 * corners(other)).cwiseAbs().maxCoeff(); // centimetres, metres
    };
    CHECK(distance(io::parse_mesh<double>(fbx), rig.mesh) < 1e-4);
    for (const int frame : {0, 7, 19}) {
        io::ReadMeshOptions options;
        options.animation = "turning";
        options.time = frame * animation.seconds_per_frame;
        TriangleMesh<double> posed = rig.mesh;
        posed.vertices = applications::skinned_linearly(
            rig.mesh.vertices, rig.skin,
            applications::motions(rig.joints, animation.frames[static_cast<std::size_t>(frame)]));
        CHECK(distance(io::parse_mesh<double>(fbx, options), posed) < 1e-3);
    }
}

TEST_CASE("FBX: a mesh without a rig keeps its numbers", "[codecs][fbx]") {
    const auto mesh = test::box({0.2, 1.7, 0.3}, 2);
    const auto back = io::parse_mesh<double>(io::format_mesh(mesh, io::MeshFormat::fbx));
    REQUIRE(back.faces.rows() == mesh.faces.rows());
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i)
        CHECK((back.vertices.row(back.faces.data()[i]) - mesh.vertices.row(mesh.faces.data()[i])).norm() < 1e-6);
}

#endif

} // namespace

#endif
