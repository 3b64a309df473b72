#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include <skelgen/applications/rig.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/io/scene_looks.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "applications/template_rig.hpp"
#include "catch.hpp"
#include "gltf_builder.hpp"
#include "io/base64.hpp"
#include "io/tangents.hpp"
#include "shapes.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace skelgen;
using applications::Rig;

/// A box with joints of human21 in its rest pose; which of them moves what does not matter here.
Rig<double> small_rig() {
    Rig<double> rig;
    rig.mesh = test::box({0.2, 1.7, 0.3}, 2);
    rig.rest = applications::RestPose::t_pose;
    rig.unit_is_known = true;
    rig.joints = test::template_joints();
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(rig.mesh.vertices.rows(), 21);
    weights.col(0).setConstant(1.0 / 3);
    weights.col(3).setConstant(2.0 / 3);
    rig.joints[1].confidence = 0.25;
    rig.skin = applications::strongest_influences<double>(weights);
    return rig;
}

nlohmann::json json_of(const std::string& glb) {
    const auto length = static_cast<unsigned char>(glb[12]) + 256U * static_cast<unsigned char>(glb[13]) +
                        65536U * static_cast<unsigned char>(glb[14]);
    return nlohmann::json::parse(glb.substr(20, length));
}

TEST_CASE("GLB: read back the mesh is where it was, skinned by nodes at rest", "[io][rig]") {
    const Rig<double> rig = small_rig();
    const std::string glb = io::rig_to_glb(rig);
    const auto back = io::parse_mesh<double>(glb); // applies nodes, skin, inverse bind matrices and weights
    REQUIRE(back.faces == rig.mesh.faces);
    CHECK((back.vertices - rig.mesh.vertices).cwiseAbs().maxCoeff() < 1e-6);
    const auto json = json_of(glb);
    CHECK(json.at("skins").at(0).at("joints").size() == 21);
    CHECK(json.at("nodes").at(1).at("name") == "crotch");
    CHECK(json.at("nodes").at(2).at("extras").at("confidence") == 0.25);
    CHECK(json.at("meshes").at(0).at("primitives").at(0).at("attributes").contains("NORMAL"));
    CHECK_FALSE(json.contains("extensionsUsed"));
}

TEST_CASE("GLB: a turned joint moves the mesh", "[io][rig]") {
    Rig<double> rig = small_rig();
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(rig.mesh.vertices.rows(), 21);
    weights.col(0).setOnes();
    rig.skin = applications::strongest_influences<double>(weights);
    const Rig<double> still = rig;
    std::string glb = io::rig_to_glb(rig);
    // The root's place in the file's JSON, moved by a metre: so is the whole mesh.
    const std::string from = "\"translation\":[0.0,0.953,0.0]", to = "\"translation\":[1.0,0.953,0.0]";
    const auto at = glb.find(from);
    REQUIRE(at != std::string::npos);
    glb.replace(at, from.size(), to);
    const auto moved = io::parse_mesh<double>(glb);
    CHECK(((moved.vertices - still.mesh.vertices).rowwise() - Eigen::RowVector3d(1, 0, 0)).cwiseAbs().maxCoeff() <
          1e-6);
}

TEST_CASE("GLB: parts of a scene keep materials, texture coordinates and pictures", "[io][rig]") {
    test::GltfBuilder scene;
    scene.add_tetrahedron();
    const auto coordinates = scene.add<float>("VEC2", {0, 0, 0.5F, 0.25F, 1, 0, 1, 1});
    auto& primitive = scene.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = coordinates;
    primitive["attributes"]["COLOR_0"] = scene.add<float>("VEC3", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5F, 0.25F, 2});
    primitive["material"] = 0;
    scene.json["materials"] = {{{"name", "skin"},
                                {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                                {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}}};
    scene.json["textures"] = {{{"source", 0}}};
    scene.json["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
    scene.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_lights_punctual"};
    const test::TemporaryFolder folder;
    std::ofstream(folder / "scene.glb", std::ios::binary) << scene.glb();
    const auto looks = io::read_looks(folder / "scene.glb");
    REQUIRE(looks);
    REQUIRE(looks->parts.size() == 1);
    CHECK(looks->parts[0].vertices == 4);
    CHECK(looks->parts[0].faces == 4);
    REQUIRE(looks->parts[0].colours.rows() == 4);
    CHECK(looks->parts[0].colours.row(3) == Eigen::RowVector4f(0.5F, 0.25F, 1, 1)); // opaque, within 0 and 1
    CHECK(looks->pictures == std::vector<std::string>{"\x89PNG\r\n\x1A\n"});

    Rig<double> rig = small_rig();
    CHECK_THROWS_WITH(io::rig_to_glb(rig, io::JointNames::skelgen, *looks), Catch::Matchers::Contains("another mesh"));
    rig.mesh = io::read_mesh(folder / "scene.glb");
    rig.skin.joints.conservativeResize(4, Eigen::NoChange);
    rig.skin.weights.conservativeResize(4, Eigen::NoChange);
    std::ofstream(folder / "rig.glb", std::ios::binary) << io::rig_to_glb(rig, io::JointNames::skelgen, *looks);
    const auto again = io::read_looks(folder / "rig.glb");
    REQUIRE(again);
    CHECK(again->parts[0].texture_coordinates == looks->parts[0].texture_coordinates);
    CHECK(again->parts[0].colours == looks->parts[0].colours);
    CHECK(again->pictures == looks->pictures);
    CHECK(again->json == looks->json);
    CHECK(again->json.find("KHR_materials_unlit") != std::string::npos);
    CHECK(again->json.find("KHR_lights_punctual") == std::string::npos); // no material needs it

    // The mesh alone, in another pose, keeps them, too.
    TriangleMesh<double> held = rig.mesh;
    held.vertices.array() += 1;
    io::write_mesh(folder / "held.glb", held, *looks);
    const auto of_held = io::read_looks(folder / "held.glb");
    REQUIRE(of_held);
    CHECK(of_held->parts[0].texture_coordinates == looks->parts[0].texture_coordinates);
    CHECK(of_held->parts[0].colours == looks->parts[0].colours);
    CHECK(of_held->pictures == looks->pictures);
    CHECK(of_held->json == looks->json);
    const auto held_again = io::read_mesh(folder / "held.glb");
    CHECK(held_again.faces == held.faces);
    CHECK((held_again.vertices - held.vertices).cwiseAbs().maxCoeff() < 1e-6);
    CHECK_THROWS_WITH(io::write_mesh(folder / "x.glb", small_rig().mesh, *looks),
                      Catch::Matchers::Contains("another mesh"));
    std::ofstream(folder / "mesh.off") << "OFF\n0 0 0\n";
    CHECK_FALSE(io::read_looks(folder / "mesh.off"));

    primitive["material"] = 1;
    std::ofstream(folder / "scene.glb", std::ios::binary) << scene.glb();
    CHECK_THROWS_AS(io::read_looks(folder / "scene.glb"), Error);
}

TEST_CASE("glTF: a picture that is missing or damaged is left out with what shows it alone", "[io][rig]") {
    test::GltfBuilder scene;
    scene.add_tetrahedron();
    scene.primitive()["material"] = 0;
    const auto texture = [](int index) { return nlohmann::json{{"index", index}, {"texCoord", 1}}; };
    scene.json["materials"] = {{{"name", "skin"},
                                {"pbrMetallicRoughness",
                                 {{"baseColorFactor", {1, 0.5, 0.25, 1}},
                                  {"baseColorTexture", texture(0)},
                                  {"metallicRoughnessTexture", texture(2)}}},
                                {"normalTexture", texture(1)},
                                {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatTexture", texture(0)}}}}}}};
    // The last one has another picture for those who do not know WebP.
    scene.json["textures"] = {
        {{"source", 0}}, {{"source", 1}}, {{"source", 3}, {"extensions", {{"EXT_texture_webp", {{"source", 2}}}}}}};
    const std::string png = "data:image/png;base64,iVBORw0KGgo=";
    scene.json["images"] = {{{"uri", "missing.png"}}, {{"uri", png}}, {{"uri", "data:image/png,raw"}}, {{"uri", png}}};
    const test::TemporaryFolder folder;
    std::ofstream(folder / "scene.glb", std::ios::binary) << scene.glb();
    const auto looks = io::read_looks(folder / "scene.glb");
    REQUIRE(looks);
    REQUIRE(looks->lost_pictures.size() == 2);
    CHECK_THAT(looks->lost_pictures[0], Catch::Matchers::Contains("missing.png"));
    CHECK(looks->pictures.size() == 2);
    const auto json = nlohmann::json::parse(looks->json);
    CHECK(json.at("images").size() == 2);
    CHECK(json.at("textures") ==
          nlohmann::json{{{"source", 0}}, {{"source", 1}, {"extensions", nlohmann::json::object()}}});
    const auto& material = json.at("materials").at(0);
    CHECK(material.at("name") == "skin");
    CHECK(material.at("normalTexture") == texture(0));
    CHECK(material.at("pbrMetallicRoughness") ==
          nlohmann::json{{"baseColorFactor", {1, 0.5, 0.25, 1}}, {"metallicRoughnessTexture", texture(1)}});
    CHECK(material.at("extensions").at("KHR_materials_clearcoat").empty());

    scene.json["textures"][0]["source"] = 4;
    std::ofstream(folder / "scene.glb", std::ios::binary) << scene.glb();
    CHECK_THROWS_WITH(io::read_looks(folder / "scene.glb"), Catch::Matchers::Contains("textures[0].source"));
}

TEST_CASE("glTF: materials that are none, or refer to what is not there, are named", "[io][rig]") {
    const auto failure = [](const char* materials, const char* textures) {
        test::GltfBuilder scene;
        scene.add_tetrahedron();
        scene.json["materials"] = nlohmann::json::parse(materials);
        scene.json["textures"] = nlohmann::json::parse(textures);
        scene.json["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
        try {
            static_cast<void>(io::parse_looks(scene.glb()));
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::bad_input);
            return std::string(error.what());
        }
        return std::string();
    };
    using Catch::Matchers::Contains;
    const char* const sound = R"([{"normalTexture": {"index": 0}}])";
    CHECK(failure(sound, R"([{"source": 0}])").empty());
    CHECK_THAT(failure("[7]", "[]"), Contains("materials[0] is no object"));
    CHECK_THAT(failure(R"([{"normalTexture": 5}])", "[]"), Contains("materials[0].normalTexture is no object"));
    CHECK_THAT(failure(R"([{"normalTexture": {"index": 0, "texCoord": "x"}}])", "[{}]"), Contains("texCoord"));
    CHECK_THAT(failure(R"([{"pbrMetallicRoughness": {"baseColorTexture": {}}}])", "[]"), Contains("index"));
    CHECK_THAT(failure(sound, "[]"),
               Contains("materials[0].normalTexture.index refers to an entry that does not exist"));
    CHECK_THAT(failure(sound, "[3]"), Contains("textures[0] is no object"));
    CHECK_THAT(failure(sound, R"([{"source": 1}])"),
               Contains("textures[0].source refers to an entry that does not exist"));
    CHECK_THAT(failure(sound, R"([{"sampler": 0}])"), Contains("samplers"));
    CHECK_THAT(failure(R"([{"extensions": {"a": {"bTexture": {"index": 1}}}}])", "[{}]"), Contains("bTexture.index"));
}

TEST_CASE("glTF: pictures that are none are left out, whatever the file calls them", "[io][rig]") {
    for (const char* const bytes : {"", "dmVyc2lvbiBodHRwczo=", "R0lGODlh"}) { // none, a text, a GIF
        test::GltfBuilder scene;
        scene.add_tetrahedron();
        scene.primitive()["material"] = 0;
        scene.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
        scene.json["textures"] = {{{"source", 0}}};
        scene.json["images"] = {{{"uri", std::string("data:image/png;base64,") + bytes}, {"mimeType", "image/png"}}};
        const auto looks = io::parse_looks(scene.glb());
        REQUIRE(looks);
        REQUIRE(looks->lost_pictures.size() == 1);
        CHECK_THAT(looks->lost_pictures[0], Catch::Matchers::Contains("no picture of a known kind"));
        CHECK(looks->json == R"({"materials":[{}]})");
    }
}

TEST_CASE("glTF: looks in a file's content, also behind a byte order mark", "[io][rig]") {
    test::GltfBuilder scene;
    scene.add_tetrahedron();
    scene.json["materials"] = {{{"name", "skin"}}};
    scene.json["images"] = {{{"uri", "beside.png"}}};
    const auto looks = io::parse_looks(scene.glb());
    REQUIRE(looks);
    CHECK(looks->json == R"({"materials":[{"name":"skin"}]})");
    REQUIRE(looks->lost_pictures.size() == 1);
    CHECK_THAT(looks->lost_pictures[0], Catch::Matchers::Contains("beside.png"));

    scene.json["buffers"][0]["byteLength"] = scene.bytes.size();
    scene.json["buffers"][0]["uri"] = "data:;base64," + io::detail::encode_base64(scene.bytes);
    const auto with_mark = io::parse_looks("\xEF\xBB\xBF" + scene.json.dump());
    REQUIRE(with_mark);
    CHECK(with_mark->parts.size() == 1);
}

TEST_CASE("glTF: texture coordinates and colours that are no numbers are read as 0", "[io][rig]") {
    test::GltfBuilder scene;
    scene.add_tetrahedron();
    const float none = std::numeric_limits<float>::quiet_NaN(), much = std::numeric_limits<float>::infinity();
    auto& attributes = scene.primitive()["attributes"];
    attributes["TEXCOORD_0"] = scene.add<float>("VEC2", {0.5F, none, much, 1, 1, 1, 1, 1});
    attributes["COLOR_0"] = scene.add<float>("VEC3", {0.5F, none, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    const auto looks = io::parse_looks(scene.glb());
    REQUIRE(looks);
    CHECK(looks->parts[0].texture_coordinates[0].topRows<2>() == Eigen::Matrix2f{{0.5F, 0}, {0, 1}});
    CHECK(looks->parts[0].colours.row(0) == Eigen::RowVector4f(0.5F, 0, 1, 1));
}

TEST_CASE("GLB and VRM: names that are no UTF-8 are written as such", "[io][rig]") {
    Rig<double> rig = small_rig();
    applications::Animation<double> animation;
    animation.name = "walk\xFF";
    animation.seconds_per_frame = 0.1;
    animation.frames.resize(1);
    animation.frames[0].axes.resize(rig.joints.size(), Eigen::Quaterniond::Identity());
    const auto named = json_of(io::rig_to_glb(rig, io::JointNames::skelgen, {}, {animation}));
    CHECK(named.at("animations").at(0).at("name") == "walk\xEF\xBF\xBD");
    rig.rest = applications::RestPose::t_pose;
    const auto avatar = json_of(io::rig_to_vrm(rig, "body\xFF"));
    CHECK(avatar.at("extensions").at("VRMC_vrm").at("meta").at("name") == "body\xEF\xBF\xBD");
}

TEST_CASE("tangents: along the first texture coordinate, and whether the picture is mirrored", "[io][rig]") {
    io::detail::FloatRows places(4, 3), normals(4, 3), coordinates(4, 2);
    places << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0;
    normals << 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1;
    coordinates << 0, 1, 1, 1, 1, 0, 0, 0; // the picture upright: glTF counts from its top
    const std::vector<std::uint32_t> faces{0, 1, 2, 0, 2, 3};
    const auto plain = io::detail::tangents(places, normals, faces, coordinates);
    coordinates.col(0) = 1 - coordinates.col(0).array();
    const auto mirrored = io::detail::tangents(places, normals, faces, coordinates);
    coordinates.setZero();
    const auto unknown = io::detail::tangents(places, normals, faces, coordinates);
    for (int v = 0; v < 4; ++v) {
        CHECK((plain.row(v) - Eigen::RowVector4f(1, 0, 0, 1)).norm() < 1e-6F);
        CHECK((mirrored.row(v) - Eigen::RowVector4f(-1, 0, 0, -1)).norm() < 1e-6F);
        CHECK(unknown.row(v).head<3>().norm() == Approx(1));
        CHECK(unknown(v, 2) == Approx(0).margin(1e-6));
    }
}

TEST_CASE("names: each convention's own, for all joints", "[io][rig]") {
    const auto joints = small_rig().joints;
    // Of skelgen, SMPL, Mixamo (without its prefix) and VRM 1.0; sides in front, as each has them.
    const std::vector<std::array<const char*, 4>> table{
        {"crotch", "pelvis", "Hips", "hips"},
        {"waist", "spine1", "Spine", "spine"},
        {"chest", "spine3", "Spine2", "chest"},
        {"neck", "neck", "Neck", "neck"},
        {"head", "head", "Head", "head"},
        {"left_shoulder", "left_shoulder", "LeftArm", "leftUpperArm"},
        {"left_elbow", "left_elbow", "LeftForeArm", "leftLowerArm"},
        {"left_wrist", "left_wrist", "LeftHand", "leftHand"},
        {"left_hand", "left_hand", "LeftHandMiddle1", "leftMiddleProximal"},
        {"right_shoulder", "right_shoulder", "RightArm", "rightUpperArm"},
        {"right_elbow", "right_elbow", "RightForeArm", "rightLowerArm"},
        {"right_wrist", "right_wrist", "RightHand", "rightHand"},
        {"right_hand", "right_hand", "RightHandMiddle1", "rightMiddleProximal"},
        {"left_hip", "left_hip", "LeftUpLeg", "leftUpperLeg"},
        {"left_knee", "left_knee", "LeftLeg", "leftLowerLeg"},
        {"left_ankle", "left_ankle", "LeftFoot", "leftFoot"},
        {"left_foot", "left_foot", "LeftToeBase", "leftToes"},
        {"right_hip", "right_hip", "RightUpLeg", "rightUpperLeg"},
        {"right_knee", "right_knee", "RightLeg", "rightLowerLeg"},
        {"right_ankle", "right_ankle", "RightFoot", "rightFoot"},
        {"right_foot", "right_foot", "RightToeBase", "rightToes"}};
    for (const std::size_t convention : {0U, 1U, 2U, 3U}) {
        const auto found = io::names_of(joints, static_cast<io::JointNames>(convention));
        REQUIRE(found.size() == table.size());
        std::set<std::string> wanted;
        for (const auto& row : table) wanted.insert(row[convention]);
        CHECK(std::set<std::string>(found.begin(), found.end()) == wanted);
        for (std::size_t j = 0; j < joints.size(); ++j) {
            INFO(joints[j].name);
            const auto row =
                std::find_if(table.begin(), table.end(), [&](const auto& one) { return joints[j].name == one[0]; });
            REQUIRE(row != table.end());
            CHECK(found[j] == (*row)[convention]);
        }
    }
    auto two_necks = joints;
    two_necks.push_back(two_necks[3]);
    two_necks.back().name = "upper_neck";
    CHECK(io::names_of(two_necks, io::JointNames::mixamo).back() == "upper_neck");
    CHECK(io::joint_names_named("mixamo") == io::JointNames::mixamo);
    // Those of engines, by joints of the trunk, the left arm and the right leg.
    const auto named = [&](const char* convention) {
        const auto all = io::names_of(joints, *io::joint_names_named(convention));
        return std::vector<std::string>{all[0], all[2], all[6], all[8], all[17], all[20]};
    };
    using Names = std::vector<std::string>;
    CHECK(named("smplx") == Names{"pelvis", "spine3", "left_elbow", "left_middle1", "right_hip", "right_foot"});
    CHECK(named("unity") == Names{"Hips", "Chest", "LeftLowerArm", "LeftMiddleProximal", "RightUpperLeg", "RightToes"});
    CHECK(named("godot") == Names{"Hips", "Chest", "LeftLowerArm", "LeftMiddleProximal", "RightUpperLeg", "RightToes"});
    CHECK(named("unreal") == Names{"pelvis", "spine_03", "lowerarm_l", "middle_01_l", "thigh_r", "ball_r"});
    CHECK(named("rigify") == Names{"spine", "spine.003", "forearm.L", "f_middle.01.L", "thigh.R", "toe.R"});
    CHECK(io::joint_names().size() == 11);
    CHECK_FALSE(io::joint_names_named("maya"));
}

TEST_CASE("VRM: all bones of a humanoid; only in the T-pose and with a name", "[io][rig]") {
    const auto vrm = json_of(io::rig_to_vrm(small_rig(), "someone")).at("extensions").at("VRMC_vrm");
    CHECK(vrm.at("specVersion") == "1.0");
    CHECK(vrm.at("meta").at("name") == "someone");
    CHECK(vrm.at("humanoid").at("humanBones").size() == 21);
    CHECK(vrm.at("humanoid").at("humanBones").at("leftMiddleProximal").at("node") == 9);
    Rig<double> rig = small_rig();
    CHECK_THROWS_AS(io::rig_to_vrm(rig, ""), Error);
    rig.rest = applications::RestPose::as_is;
    CHECK_THROWS_AS(io::rig_to_vrm(rig, "someone"), Error);
    rig = small_rig();
    rig.joints[1].role = JointRole::chest; // no spine any more
    CHECK_THROWS_WITH(io::rig_to_vrm(rig, "someone"), Catch::Matchers::Contains("spine"));
}

TEST_CASE("BVH: offsets in centimetres, Z, X, Y", "[io][rig]") {
    const std::string bvh = io::rig_to_bvh(small_rig(), io::JointNames::mixamo);
    CHECK(bvh.rfind("HIERARCHY\nROOT Hips\n{\n\tOFFSET 0 0 0\n\tCHANNELS 6 Xposition Yposition Zposition "
                    "Zrotation Xrotation Yrotation\n\tJOINT Spine\n",
                    0) == 0);
    CHECK(bvh.find("Frames: 1\nFrame Time: 0.03333333333333333\n0 95.3") != std::string::npos);
    std::size_t ends = 0;
    for (auto at = bvh.find("End Site"); at != std::string::npos; at = bvh.find("End Site", at + 1)) ++ends;
    CHECK(ends == 5);
    Rig<double> rig = small_rig();
    rig.unit_is_known = false;
    CHECK(io::rig_to_bvh(rig).find("\n0 0.953") != std::string::npos);
}

TEST_CASE("rigs that cannot be written", "[io][rig]") {
    Rig<double> rig = small_rig();
    CHECK_THROWS_AS(io::write_rig("rig.dae", rig), Error);
    rig.mesh.vertices(0, 0) = 1e300;
    CHECK_THROWS_WITH(io::rig_to_glb(rig), Catch::Matchers::Contains("float"));
    rig.mesh.faces.resize(0, 3);
    CHECK_THROWS_AS(io::rig_to_glb(rig), Error);
}

} // namespace
