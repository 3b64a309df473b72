// What a scene has beside its mesh comes out of a rig as it went in: compared field by field.

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <skelgen/applications/rig.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/io/scene_looks.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "applications/template_rig.hpp"
#include "catch.hpp"
#include "gltf_builder.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace skelgen;
using test::GltfBuilder;
using Json = nlohmann::json;

Json json_of_glb(const std::string& glb) {
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(glb[i])); };
    return Json::parse(glb.substr(20, byte(12) + (byte(13) << 8U) + (byte(14) << 16U)));
}

/// A rig of a scene's mesh: twice as large, each vertex turned by an angle of its own, as skinning does it.
applications::Rig<double> rig_of(const TriangleMesh<double>& mesh) {
    applications::Rig<double> rig;
    rig.mesh = mesh;
    rig.metres_per_unit = 2;
    rig.unit_is_known = true;
    rig.rest = applications::RestPose::t_pose;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        rig.turns.emplace_back(Eigen::AngleAxisd(0.3 * static_cast<double>(v), Eigen::Vector3d(1, 2, 3).normalized()));
        rig.mesh.vertices.row(v) = 2 * (rig.turns.back() * mesh.vertices.row(v).transpose()).transpose();
    }
    const Eigen::Quaterniond quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY()));
    rig.joints = test::template_joints();
    rig.motions.assign(rig.joints.size(), {quarter, Eigen::Vector3d(0, 1, 0)});
    rig.skin.joints.setZero(mesh.vertices.rows(), 4);
    rig.skin.weights.setZero(mesh.vertices.rows(), 4);
    rig.skin.weights.col(0).setOnes();
    return rig;
}

/// Two objects: a face with three morph targets (all vertices; one vertex, sparse, with a normal; none), in a turned
/// and scaled node; and a body without.
GltfBuilder scene_with_morphs() {
    GltfBuilder scene;
    scene.add_tetrahedron();
    scene.add_tetrahedron();
    Json& face = scene.json["meshes"][0];
    Json& primitive = face["primitives"][0];
    primitive["attributes"]["NORMAL"] = scene.add<float>("VEC3", {0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 1});
    const auto all = scene.add<float>("VEC3", {0.5F, 0, 0, 0, 0.25F, 0, 0, 0, 0.125F, 1, 1, 1});
    const auto places = scene.add_view(GltfBuilder::raw<std::uint16_t>({2}));
    const auto rows = scene.add_view(GltfBuilder::raw<float>({0, 0.5F, 0}));
    const auto normal_rows = scene.add_view(GltfBuilder::raw<float>({-1, 1, 0}));
    const auto add_sparse = [&](std::size_t values) {
        scene.json["accessors"].push_back({{"componentType", 5126},
                                           {"count", 4},
                                           {"type", "VEC3"},
                                           {"sparse",
                                            {{"count", 1},
                                             {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                                             {"values", {{"bufferView", values}}}}}});
        return scene.json["accessors"].size() - 1;
    };
    const std::size_t one = add_sparse(rows), one_normal = add_sparse(normal_rows);
    const auto none = scene.add<float>("VEC3", std::vector<float>(12, 0));
    primitive["targets"] = {{{"POSITION", all}}, {{"POSITION", one}, {"NORMAL", one_normal}}, {{"POSITION", none}}};
    face["weights"] = {0.5, 0.0, 0.25};
    face["extras"] = {{"targetNames", {"smile", "blink", "nothing"}}, {"maker", "somebody"}};
    face["name"] = "face mesh";
    const double half = std::sqrt(0.5);
    scene.json["nodes"] = {{{"name", "Face"},
                            {"mesh", 0},
                            {"scale", {2, 2, 2}},
                            {"rotation", {0, half, 0, half}}, // a quarter about y: x becomes -z
                            {"extras", {{"layer", 3}}}},
                           {{"name", "Body"}, {"mesh", 1}, {"translation", {0, 0, 5}}}};
    scene.json["scenes"][0]["nodes"] = {0, 1};
    scene.json["asset"]["copyright"] = "somebody";
    scene.json["asset"]["extras"] = {{"license", "CC0"}};
    scene.json["animations"] = Json::array({Json::object(), Json::object()});
    return scene;
}

TEST_CASE("GLB: objects keep names, extras and morph targets, which are turned as the vertices are", "[io][rig]") {
    const GltfBuilder scene = scene_with_morphs();
    const auto looks = io::parse_looks(scene.glb());
    REQUIRE(looks);
    REQUIRE(looks->objects.size() == 2);
    CHECK(looks->left_out == std::vector<std::string>{"2 animations"});
    const io::SceneObject& face = looks->objects[0];
    REQUIRE(face.morphs.size() == 3);
    CHECK(face.weights == std::vector<double>{0.5, 0, 0.25});
    CHECK(face.morphs[0].vertices == std::vector<int>{0, 1, 2, 3});
    CHECK(face.morphs[0].positions.isApprox(
        2 * Eigen::Matrix<float, 4, 3>{{0, 0, -0.5F}, {0, 0.25F, 0}, {0.125F, 0, 0}, {1, 1, -1}}));
    CHECK(face.morphs[1].vertices == std::vector<int>{2});
    CHECK((face.morphs[1].positions.row(0) - Eigen::RowVector3f(0, 1, 0)).norm() < 1e-6F);
    CHECK((face.morphs[1].normals.row(0) - Eigen::RowVector3f(0, 1, 1)).norm() < 1e-6F); // of unit length, unscaled
    CHECK(face.morphs[2].vertices.empty());
    CHECK(looks->objects[1].morphs.empty());

    const auto mesh = io::parse_mesh<double>(scene.glb());
    const auto rig = rig_of(mesh);
    const std::string glb = io::rig_to_glb(rig, io::JointNames::skelgen, *looks);
    const Json json = json_of_glb(glb);
    for (const Json& accessor : json.at("accessors"))
        CHECK(accessor.contains(
            "bufferView")); // also of zeros alone: some engines read the first view where there is none
    CHECK(json.at("nodes").at(0).at("name") == "Face");
    CHECK(json.at("nodes").at(0).at("extras") == Json{{"layer", 3}});
    CHECK(json.at("nodes").at(1).at("name") == "Body");
    CHECK(json.at("nodes").at(1).at("skin") == 0);
    CHECK(json.at("meshes").at(0).at("name") == "face mesh");
    CHECK(json.at("meshes").at(0).at("extras") == scene.json.at("meshes").at(0).at("extras"));
    CHECK(json.at("meshes").at(0).at("weights") == Json{0.5, 0.0, 0.25});
    CHECK_FALSE(json.at("meshes").at(1).contains("weights"));
    CHECK(json.at("asset").at("copyright") == "somebody");
    CHECK(json.at("asset").at("extras").at("license") == "CC0");

    // With the weights that the file has, vertices are where the rig has them.
    const auto back = io::parse_mesh<double>(glb);
    CHECK(back.faces == mesh.faces);
    CHECK((back.vertices - rig.mesh.vertices).cwiseAbs().maxCoeff() < 1e-5);
    const auto again = io::parse_looks(glb);
    REQUIRE(again);
    REQUIRE(again->objects.size() == 2);
    REQUIRE(again->objects[0].morphs.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const io::MorphTarget &was = face.morphs[i], &now = again->objects[0].morphs[i];
        REQUIRE(now.vertices == was.vertices);
        for (std::size_t k = 0; k < was.vertices.size(); ++k) {
            const auto row = static_cast<Eigen::Index>(k);
            const auto turned = [&](const auto& rows) -> Eigen::Vector3d {
                return rig.turns[static_cast<std::size_t>(was.vertices[k])] *
                       rows.row(row).transpose().template cast<double>();
            };
            CHECK((now.positions.row(row).transpose().cast<double>() - 2 * turned(was.positions)).norm() < 1e-5);
            if (was.normals.rows() > 0)
                CHECK((now.normals.row(row).transpose().cast<double>() - turned(was.normals)).norm() < 1e-5);
        }
    }
    CHECK(again->objects[0].mesh_extras == face.mesh_extras);

    // The mesh alone keeps them, too, where it is known how its vertices have been turned.
    const test::TemporaryFolder folder;
    io::write_mesh(folder / "held.glb", rig.mesh, *looks, rig.turns);
    const auto held = io::read_looks(folder / "held.glb");
    REQUIRE(held);
    REQUIRE(held->objects[0].morphs.size() == 3);
    CHECK(held->objects[0].name == "Face");
    CHECK((io::read_mesh(folder / "held.glb").vertices - rig.mesh.vertices).cwiseAbs().maxCoeff() < 1e-5);
    CHECK(held->objects[0].weights == face.weights);
}

TEST_CASE("GLB: morph targets that do not hold together are left out alone, which is said", "[io][rig]") {
    GltfBuilder scene = scene_with_morphs();
    scene.json["meshes"][0]["primitives"][0]["targets"][2]["POSITION"] = scene.add<float>("VEC3", {1, 2, 3});
    scene.json["meshes"][0]["weights"] = {0, 0, 0};
    const auto looks = io::parse_looks(scene.glb());
    REQUIRE(looks);
    REQUIRE(looks->left_out.size() == 2);
    CHECK_THAT(looks->left_out[1], Catch::Matchers::Contains("another number of vertices"));
    REQUIRE(looks->objects.size() == 2);
    CHECK(looks->objects[0].morphs.empty());
    CHECK(looks->objects[0].name == "Face");
}

/// What both versions say, in VRM 1.0's terms, of an avatar whose face is node 0 and whose head is node 3.
const char* const vrm_1 = R"({
  "VRMC_vrm": {
    "specVersion": "1.0",
    "meta": {"name": "Ada", "authors": ["A", "B"], "licenseUrl": "https://vrm.dev/licenses/1.0/", "version": "7",
      "otherLicenseUrl": "https://example.org/terms", "allowRedistribution": true, "thumbnailImage": 4,
      "modification": "allowModification", "avatarPermission": "everyone", "commercialUsage": "corporation"},
    "humanoid": {"humanBones": {"hips": {"node": 2}, "head": {"node": 3}, "chest": {"node": 2}}},
    "firstPerson": {"meshAnnotations": [{"node": 0, "type": "thirdPersonOnly"}, {"node": 1, "type": "both"}]},
    "lookAt": {"type": "bone", "offsetFromHeadBone": [0, 0.5, 0],
      "rangeMapHorizontalInner": {"inputMaxValue": 90, "outputScale": 8}},
    "expressions": {
      "preset": {"happy": {"isBinary": true, "overrideBlink": "block",
        "morphTargetBinds": [{"node": 0, "index": 1, "weight": 0.75}, {"node": 0, "index": 9, "weight": 1}],
        "materialColorBinds": [{"material": 0, "type": "color", "targetValue": [1, 0, 0, 1]}]}},
      "custom": {"wink": {"morphTargetBinds": [{"node": 0, "index": 0, "weight": 1}]}}}
  },
  "VRMC_springBone": {"specVersion": "1.0",
    "colliders": [{"node": 3, "shape": {"sphere": {"offset": [0, 0.5, 0], "radius": 0.25}}},
                  {"node": 5, "shape": {"sphere": {"offset": [0, 0, 0], "radius": 1}}}],
    "colliderGroups": [{"name": "head", "colliders": [0, 1]}],
    "springs": [{"name": "neck", "joints": [{"node": 2, "hitRadius": 0.5, "stiffness": 2}, {"node": 3}], "colliderGroups": [0]},
                {"name": "hair", "joints": [{"node": 3}, {"node": 5}]}]}
})";

GltfBuilder avatar(const Json& extensions) {
    GltfBuilder scene = scene_with_morphs();
    scene.json.erase("animations");
    scene.json["asset"].erase("copyright");
    scene.json["asset"].erase("extras");
    scene.json["extensions"] = extensions;
    scene.json["materials"] = {{{"name", "skin"}}};
    scene.json["nodes"].push_back({{"name", "Hips"}, {"children", {3, 4}}, {"translation", {0, 1, 0}}});
    scene.json["nodes"].push_back({{"name", "Head"}, {"children", {5}}, {"translation", {0, 2, 0}}});
    scene.json["nodes"].push_back({{"name", "Tail"}});
    scene.json["nodes"].push_back({{"name", "Hair"}});
    scene.json["scenes"][0]["nodes"] = {0, 1, 2};
    return scene;
}

std::size_t node_named(const Json& json, const std::string& name) {
    const Json& nodes = json.at("nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].at("name") == name) return i;
    FAIL("no node " << name);
    return 0;
}

TEST_CASE("VRM 1.0: what it says of an avatar is kept, by the nodes that there are", "[io][rig][vrm]") {
    const Json extensions = Json::parse(vrm_1);
    const GltfBuilder scene = avatar(extensions);
    const auto looks = io::parse_looks(scene.glb());
    REQUIRE(looks);
    CHECK(looks->forbidden.empty());
    CHECK(io::left_out_of(io::RigFormat::vrm, *looks) ==
          std::vector<std::string>{"1 springs (they swing bones that the rig does not have)"});
    CHECK(io::left_out_of(io::RigFormat::glb, *looks).size() == 1);
    const auto rig = rig_of(io::parse_mesh<double>(scene.glb()));
    const Json json = json_of_glb(io::rig_to_vrm(rig, "file name", *looks));
    const Json& vrm = json.at("extensions").at("VRMC_vrm");
    const std::size_t hips = node_named(json, "hips"), head = node_named(json, "head");

    Json meta = extensions.at("VRMC_vrm").at("meta");
    meta.erase("thumbnailImage"); // there is no such image
    Json written_meta = vrm.at("meta");
    CHECK(written_meta.at("copyrightInformation") == "A, B");
    written_meta.erase("copyrightInformation");
    CHECK(written_meta == meta);
    CHECK(json.at("asset").at("copyright") == "A, B");
    CHECK(json.at("asset").at("extras") ==
          Json{{"author", "A, B"}, {"license", "https://example.org/terms"}, {"title", "Ada"}});

    Json expressions = extensions.at("VRMC_vrm").at("expressions");
    expressions["preset"]["happy"]["morphTargetBinds"].erase(1); // there is no such target
    CHECK(vrm.at("expressions") == expressions);
    CHECK(vrm.at("firstPerson") == extensions.at("VRMC_vrm").at("firstPerson"));
    CHECK(vrm.at("lookAt").at("type") == "bone");
    CHECK(vrm.at("lookAt").at("rangeMapHorizontalInner") == Json{{"inputMaxValue", 90}, {"outputScale", 8}});

    // The eyes are half a unit above the head at (0, 3, 0); the joint has moved what is fixed to it.
    const std::size_t head_joint = 4;
    const Eigen::Vector3d eyes = rig.motions[head_joint](2 * Eigen::Vector3d(0, 3.5, 0));
    const auto in_head = [&](const Json& offset) -> Eigen::Vector3d {
        const Eigen::Vector3d own(offset[0], offset[1], offset[2]);
        return rig.joints[head_joint].axes * own + rig.joints[head_joint].position;
    };
    REQUIRE(rig.joints[head_joint].name == "head");
    CHECK((in_head(vrm.at("lookAt").at("offsetFromHeadBone")) - eyes).norm() < 1e-9);

    const Json& springs = json.at("extensions").at("VRMC_springBone");
    REQUIRE(springs.at("springs").size() == 1);
    CHECK(springs.at("springs")[0].at("joints") ==
          Json{{{"node", hips}, {"hitRadius", 1.0}, {"stiffness", 2}}, {{"node", head}}});
    REQUIRE(springs.at("colliders").size() == 1);
    CHECK(springs.at("colliders")[0].at("node") == head);
    CHECK(springs.at("colliders")[0].at("shape").at("sphere").at("radius") == 0.5);
    CHECK((in_head(springs.at("colliders")[0].at("shape").at("sphere").at("offset")) - eyes).norm() < 1e-9);
    CHECK(springs.at("colliderGroups") == Json{{{"name", "head"}, {"colliders", {0}}}});
    CHECK(json.at("extensionsUsed") == Json{"VRMC_springBone", "VRMC_vrm"});
}

TEST_CASE("VRM 0.x: what it says of an avatar is written as VRM 1.0 has it", "[io][rig][vrm]") {
    const Json old = Json::parse(R"({"VRM": {
      "meta": {"title": "Ada", "version": "7", "author": "A", "contactInformation": "a@example.org", "reference": "none",
        "allowedUserName": "ExplicitlyLicensedPerson", "violentUssageName": "Disallow", "sexualUssageName": "Disallow",
        "commercialUssageName": "Allow", "licenseName": "CC_BY_ND"},
      "humanoid": {"humanBones": [{"bone": "hips", "node": 2}, {"bone": "head", "node": 3}]},
      "firstPerson": {"firstPersonBone": 3, "firstPersonBoneOffset": {"x": 0, "y": 0.5, "z": 0.25},
        "meshAnnotations": [{"mesh": 0, "firstPersonFlag": "ThirdPersonOnly"}], "lookAtTypeName": "BlendShape",
        "lookAtVerticalUp": {"xRange": 60, "yRange": 1}},
      "blendShapeMaster": {"blendShapeGroups": [
        {"name": "Joy", "presetName": "joy", "isBinary": false, "binds": [{"mesh": 0, "index": 1, "weight": 75}],
         "materialValues": [{"materialName": "skin", "propertyName": "_Color", "targetValue": [1, 0.5, 0, 1]},
                            {"materialName": "skin", "propertyName": "_MainTex_ST", "targetValue": [0.5, 0.5, 0.25, 0]}]},
        {"name": "Wink", "presetName": "unknown", "binds": [{"mesh": 0, "index": 0, "weight": 100}]}]},
      "secondaryAnimation": {
        "boneGroups": [{"comment": "neck", "stiffiness": 2, "gravityPower": 0.5, "gravityDir": {"x": 0, "y": -1, "z": 0},
          "dragForce": 0.25, "hitRadius": 0.5, "bones": [2], "colliderGroups": [0]}],
        "colliderGroups": [{"node": 3, "colliders": [{"offset": {"x": 0, "y": 0.5, "z": 0.25}, "radius": 0.25}]}]}}})");
    GltfBuilder scene = avatar(old);
    scene.json["nodes"][3].erase("children"); // the chain from the hips ends in the head
    scene.json["nodes"][2]["children"] = {3};
    scene.json["scenes"][0]["nodes"] = {0, 1, 2};
    const auto looks = io::parse_looks(scene.glb());
    REQUIRE(looks);
    CHECK(looks->forbidden == "modification");
    CHECK(io::left_out_of(io::RigFormat::vrm, *looks).empty());
    const auto rig = rig_of(io::parse_mesh<double>(scene.glb()));
    const Json json = json_of_glb(io::rig_to_vrm(rig, "file name", *looks));
    const Json& vrm = json.at("extensions").at("VRMC_vrm");
    CHECK(vrm.at("meta") == Json{{"name", "Ada"},
                                 {"version", "7"},
                                 {"authors", {"A"}},
                                 {"contactInformation", "a@example.org"},
                                 {"references", {"none"}},
                                 {"avatarPermission", "onlySeparatelyLicensedPerson"},
                                 {"allowExcessivelyViolentUsage", false},
                                 {"allowExcessivelySexualUsage", false},
                                 {"commercialUsage", "personalProfit"},
                                 {"creditNotation", "required"},
                                 {"allowRedistribution", true},
                                 {"modification", "prohibited"},
                                 {"otherLicenseUrl", "https://creativecommons.org/licenses/by-nd/4.0/"},
                                 {"copyrightInformation", "A"},
                                 {"licenseUrl", "https://vrm.dev/licenses/1.0/"}});
    const Json& happy = vrm.at("expressions").at("preset").at("happy");
    CHECK(happy.at("isBinary") == false);
    CHECK(happy.at("morphTargetBinds") == Json{{{"node", 0}, {"index", 1}, {"weight", 0.75}}});
    REQUIRE(happy.at("materialColorBinds").size() == 1);
    CHECK(happy.at("materialColorBinds")[0].at("type") == "color");
    CHECK(happy.at("materialColorBinds")[0].at("targetValue")[1].get<double>() == Approx(0.21404).epsilon(1e-4));
    CHECK(happy.at("textureTransformBinds") == Json{{{"material", 0}, {"scale", {0.5, 0.5}}, {"offset", {0.25, 0.5}}}});
    CHECK(vrm.at("expressions").at("custom").at("Wink").at("morphTargetBinds") ==
          Json{{{"node", 0}, {"index", 0}, {"weight", 1.0}}});
    CHECK(vrm.at("firstPerson").at("meshAnnotations") == Json{{{"node", 0}, {"type", "thirdPersonOnly"}}});
    CHECK(vrm.at("lookAt").at("type") == "expression");
    CHECK(vrm.at("lookAt").at("rangeMapVerticalUp") == Json{{"inputMaxValue", 60.0}, {"outputScale", 1.0}});

    const Eigen::Vector3d eyes = rig.motions[4](2 * Eigen::Vector3d(0, 3.5, -0.25)); // Unity's z is glTF's mirrored
    const auto in_head = [&](const Json& offset) -> Eigen::Vector3d {
        return rig.joints[4].axes * Eigen::Vector3d(offset[0], offset[1], offset[2]) + rig.joints[4].position;
    };
    CHECK((in_head(vrm.at("lookAt").at("offsetFromHeadBone")) - eyes).norm() < 1e-9);
    const Json& springs = json.at("extensions").at("VRMC_springBone");
    CHECK(springs.at("springs")[0].at("joints").size() == 2);
    CHECK(springs.at("springs")[0].at("joints")[0].at("node") == node_named(json, "hips"));
    CHECK(springs.at("springs")[0].at("joints")[0].at("stiffness") == 2.0);
    CHECK(springs.at("springs")[0].at("joints")[0].at("gravityDir") == Json{0.0, -1.0, 0.0});
    CHECK((in_head(springs.at("colliders")[0].at("shape").at("sphere").at("offset")) - eyes).norm() < 1e-9);
}

TEST_CASE("VRM: credits take the place of the input's, and unknown are only those of whom nothing is said",
          "[io][rig][vrm]") {
    const auto meta_of = [](const io::SceneLooks& looks) {
        const GltfBuilder scene = scene_with_morphs();
        const auto rig = rig_of(io::parse_mesh<double>(scene.glb()));
        return json_of_glb(io::rig_to_vrm(rig, "file name", looks)).at("extensions").at("VRMC_vrm").at("meta");
    };
    CHECK(meta_of({}) ==
          Json{{"name", "file name"}, {"authors", {"unknown"}}, {"licenseUrl", "https://vrm.dev/licenses/1.0/"}});
    const auto plain = io::parse_looks(scene_with_morphs().glb());
    REQUIRE(plain);
    CHECK(meta_of(*plain) == Json{{"name", "file name"},
                                  {"authors", {"somebody"}},
                                  {"copyrightInformation", "somebody"},
                                  {"thirdPartyLicenses", "CC0"},
                                  {"licenseUrl", "https://vrm.dev/licenses/1.0/"}});
    const io::Credits credits{"Eve", "C", "https://example.org/free"};
    const Json set = meta_of(io::with_credits(*plain, credits));
    CHECK(set.at("name") == "Eve");
    CHECK(set.at("authors") == Json{"C"});
    CHECK(set.at("otherLicenseUrl") == "https://example.org/free");
    const auto old = io::parse_looks(avatar(Json::parse(vrm_1)).glb());
    REQUIRE(old);
    const Json over = meta_of(io::with_credits(*old, {"", "C", "my own terms"}));
    CHECK(over.at("name") == "Ada");
    CHECK(over.at("authors") == Json{"C"});
    CHECK(over.at("thirdPartyLicenses") == "my own terms");
    CHECK_FALSE(over.contains("otherLicenseUrl"));
}

TEST_CASE("VRM: what a licence forbids is known, and what is silent forbids", "[io][vrm]") {
    const auto forbidden = [](const char* meta) {
        return io::parse_looks(avatar({{"VRMC_vrm", {{"meta", Json::parse(meta)}}}}).glb())->forbidden;
    };
    CHECK(forbidden("{}") == "redistribution and modification");
    CHECK(forbidden(R"({"otherLicenseUrl": "https://example.org"})").empty());
    CHECK(forbidden(R"({"allowRedistribution": true})") == "modification");
    CHECK(forbidden(R"({"allowRedistribution": false, "modification": "allowModification"})") == "redistribution");
    CHECK(forbidden(R"({"allowRedistribution": true, "modification": "allowModificationRedistribution"})").empty());
}

TEST_CASE("VRM: parts of no sound shape cost themselves alone", "[io][vrm]") {
    for (
        const char* const extensions :
        {R"({"VRMC_vrm": 7})", R"({"VRMC_vrm": {"meta": 7, "expressions": [], "lookAt": 1, "firstPerson": ""}})",
         R"({"VRMC_vrm": {"meta": {"authors": 7, "name": {}}, "humanoid": {"humanBones": {"hips": {"node": 99}, "head": 7}},
             "expressions": {"preset": {"happy": 7, "sad": {"morphTargetBinds": [7, {"node": -1}, {"node": 0}]}}},
             "lookAt": {"offsetFromHeadBone": [1, 2]}, "firstPerson": {"meshAnnotations": [7, {}]}},
             "VRMC_springBone": {"colliders": [7, {"node": 3, "shape": {"sphere": {"offset": [1]}}}],
               "colliderGroups": [7], "springs": [7, {"joints": 7}, {"joints": [7]}]}})",
         R"({"VRM": {"meta": [], "humanoid": {"humanBones": [7, {"bone": 7, "node": "x"}]},
             "blendShapeMaster": {"blendShapeGroups": [7, {"presetName": "joy", "binds": [7, {"mesh": 9}],
               "materialValues": [7, {"targetValue": ["x"]}]}]},
             "firstPerson": {"meshAnnotations": [7], "lookAtTypeName": "Bone", "firstPersonBoneOffset": {"x": "y"}},
             "secondaryAnimation": {"boneGroups": [7, {"bones": [7, 99, "x", 2]}], "colliderGroups": [7, {"node": 3, "colliders": [7]}]}}})"}) {
        const GltfBuilder scene = avatar(Json::parse(extensions));
        const auto looks = io::parse_looks(scene.glb());
        REQUIRE(looks);
        const auto rig = rig_of(io::parse_mesh<double>(scene.glb()));
        const Json json = json_of_glb(io::rig_to_vrm(rig, "file name", *looks));
        const Json& meta = json.at("extensions").at("VRMC_vrm").at("meta");
        CHECK(meta.at("authors") == Json{"unknown"});
        CHECK(meta.at("name") == "file name");
    }
}

} // namespace
