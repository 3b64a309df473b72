#include <filesystem>
#include <functional>
#include <iostream>
#include <string>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/bvh.hpp>
#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/template_json.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "io/gltf_builder.hpp"
#include "walking_clip.hpp"

using namespace skelgen;
using namespace skelgen::io;
namespace fs = std::filesystem;

namespace {

/// Puts small files for one target to begin with into a folder of its name.
class Corpus {
public:
    Corpus(const fs::path& folder, const std::string& target) : folder_(folder / target) {
        fs::create_directories(folder_);
    }
    void add(const std::string& content) {
        write_file_atomically(folder_ / ("seed" + std::to_string(count_++)), content);
    }

private:
    fs::path folder_;
    int count_ = 0;
};

TriangleMesh<double> tetrahedron() {
    TriangleMesh<double> mesh;
    mesh.vertices.resize(4, 3);
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    mesh.faces.resize(4, 3);
    mesh.faces << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    return mesh;
}

CurveSkeleton<double> fork_curve() {
    CurveSkeleton<double> curve;
    curve.nodes.resize(4, 3);
    curve.nodes << 0, 0, 0, 1, 1e5, 0.25, 2, -1, 0, 1, 1, 1;
    curve.edges = {{0, 1}, {0, 2}, {0, 3}};
    curve.radii = {1, 2, 0, 3.5};
    curve.regions = {{0, 1}, {}, {2}, {3}};
    return curve;
}

KinematicSkeleton<double> small_skeleton() {
    KinematicSkeleton<double> skeleton;
    skeleton.joints.resize(2);
    skeleton.joints[0].name = "crotch";
    skeleton.joints[1].name = "waist";
    skeleton.joints[1].parent = 0;
    skeleton.joints[1].position = {0, 0, 0.1};
    return skeleton;
}

/// With a skin, a morph target, a sparse accessor and an animation.
test::GltfBuilder full_scene() {
    test::GltfBuilder scene;
    scene.add_tetrahedron();
    const auto joints = scene.add<std::uint8_t>("VEC4", {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0});
    const auto weights = scene.add<float>("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, .5, .5, 0, 0, 1, 0, 0, 0});
    const auto offsets = scene.add<float>("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4});
    scene.primitive()["attributes"]["JOINTS_0"] = joints;
    scene.primitive()["attributes"]["WEIGHTS_0"] = weights;
    scene.primitive()["targets"] = {{{"POSITION", offsets}}};
    const auto indices = scene.add_view(test::GltfBuilder::raw<std::uint8_t>({1}));
    const auto values = scene.add_view(test::GltfBuilder::raw<float>({5, 0, 0}));
    scene.json["accessors"][0]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                            {"values", {{"bufferView", values}}}};
    const auto times = scene.add<float>("SCALAR", {0, 1});
    const auto turns = scene.add<float>("VEC4", {0, 0, 0, 1, 0, 0, 1, 0});
    scene.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}},
                           {{"children", {2}}, {"scale", {1, 2, 1}}},
                           {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}}}};
    scene.json["scenes"][0]["nodes"] = {0, 1};
    scene.json["skins"] = {{{"joints", {1, 2}}}};
    scene.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}}}},
                                 {"samplers", {{{"input", times}, {"output", turns}, {"interpolation", "LINEAR"}}}}}};
    return scene;
}

/// The same as avatars of VRM 1.0 and 0.x.
std::string avatar(const char* extensions) {
    test::GltfBuilder scene = full_scene();
    scene.json["extensions"] = test::GltfBuilder::Json::parse(extensions);
    return scene.glb();
}
constexpr const char* vrm_1 = R"({"VRMC_vrm": {"meta": {"name": "a", "authors": ["b"], "allowRedistribution": true},
    "humanoid": {"humanBones": {"hips": {"node": 1}, "head": {"node": 2}}},
    "expressions": {"preset": {"happy": {"morphTargetBinds": [{"node": 0, "index": 0, "weight": 1}]}}},
    "firstPerson": {"meshAnnotations": [{"node": 0, "type": "auto"}]},
    "lookAt": {"type": "bone", "offsetFromHeadBone": [0, 1, 0]}},
  "VRMC_springBone": {"colliders": [{"node": 2, "shape": {"capsule": {"offset": [0, 1, 0], "tail": [1, 0, 0], "radius": 1}}}],
    "colliderGroups": [{"colliders": [0]}],
    "springs": [{"joints": [{"node": 1, "hitRadius": 1}, {"node": 2}], "center": 1, "colliderGroups": [0]}]}})";
constexpr const char* vrm_0 = R"({"VRM": {"meta": {"title": "a", "licenseName": "CC_BY", "allowedUserName": "Everyone"},
    "humanoid": {"humanBones": [{"bone": "hips", "node": 1}, {"bone": "head", "node": 2}]},
    "firstPerson": {"firstPersonBoneOffset": {"x": 0, "y": 1, "z": 0}, "lookAtTypeName": "Bone",
      "meshAnnotations": [{"mesh": 0, "firstPersonFlag": "Auto"}], "lookAtVerticalUp": {"xRange": 60, "yRange": 1}},
    "blendShapeMaster": {"blendShapeGroups": [{"name": "Joy", "presetName": "joy",
      "binds": [{"mesh": 0, "index": 0, "weight": 75}],
      "materialValues": [{"materialName": "", "propertyName": "_Color", "targetValue": [1, 0, 0, 1]}]}]},
    "secondaryAnimation": {"boneGroups": [{"comment": "b", "bones": [1], "colliderGroups": [0], "center": 1}],
      "colliderGroups": [{"node": 2, "colliders": [{"offset": {"x": 0, "y": 1, "z": 0}, "radius": 1}]}]}}})";

/// With a normal map and its texture coordinates, colours and normals.
test::GltfBuilder painted_scene() {
    test::GltfBuilder scene;
    scene.add_tetrahedron();
    auto& attributes = scene.primitive()["attributes"];
    attributes["TEXCOORD_0"] = scene.add<float>("VEC2", {0, 0, 1, 0, 0, 1, 1, 1});
    attributes["COLOR_0"] = scene.add<float>("VEC3", {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
    attributes["NORMAL"] = scene.add<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0});
    scene.primitive()["material"] = 0;
    scene.json["images"] = {{{"mimeType", "image/png"},
                             {"bufferView", scene.add_view(test::GltfBuilder::raw<std::uint8_t>({137, 80, 78, 71}))}},
                            {{"uri", "missing.png"}}};
    scene.json["samplers"] = {{{"wrapS", 10497}}};
    scene.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
    scene.json["materials"] = {{{"normalTexture", {{"index", 0}, {"texCoord", 0}}},
                                {"emissiveTexture", {{"index", 1}, {"extensions", {{"a", {{"b", 1}}}}}}},
                                {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}}};
    scene.json["extensionsUsed"] = {"a", "c"};
    return scene;
}

void make_corpus(const fs::path& folder) {
    const auto mesh = tetrahedron();
    Corpus off(folder, "off"), obj(folder, "obj"), ply(folder, "ply"), stl(folder, "stl"), gltf(folder, "gltf");
    off.add(format_mesh(mesh, MeshFormat::off));
    off.add("COFF 4 1 0\n0 0 0 1 0 0 1\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 # quad\n");
    off.add("OFF BINARY\n" + std::string("\0\0\0\3\0\0\0\1\0\0\0\0", 12) + std::string(36, '\0') +
            std::string("\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\0", 20));
    obj.add(format_mesh(mesh, MeshFormat::obj));
    obj.add(
        "mtllib a b.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 255 0\nv 1 1 0\nvt 0 0\nvt 1 .5\nvn 0 0 1\nvn 0 1 nan\nusemtl a b\n"
        "f 1/1/1 2/2/2 3/-1/-1\nusemtl c\nf 3/2/1 2/1 1/9/9\n");
    obj.add("v 0 0 0\nv 1 0 0\nvt 0 0\nv 1 1 \\\n 0\nv 0 1 0\ng a\nf 1/1 2//3 3/1/1 -1\n");
    obj.add("mtllib a.mtl \\\nv 9 9 9\nv 0 0 0 1 \\\nv 9 9 9\nv 1 0 0 1 0 0 # \\\nv 0 1 0\nvt 0 1#2 \\\nusemtl C:\\\n"
            "vt 1 \\\n0.5\nf 1/1 2/2 \\\n 3/2\n");
    Corpus(folder, "mtl")
        .add("newmtl a\nKd 0.5 0.25 0\nd 0.5\nNs 250\nTr 1\nnewmtl b\nKd 0\n"
             "map_Kd -s 2 2 -bm 0.5 .\\a picture.png\nPr 0.75\nPm 1\nmap_d \"a\"\n");
    ply.add(format_mesh(mesh, MeshFormat::ply));
    ply.add(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
        "property uchar blue\nproperty uchar alpha\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
        "0 0 0 0 0 1 255 0 9 9\n1 0 0 nan 0 1 0 0 0 0\n0 1 0 0 0 0 1 1 1 1\n3 0 1 2\n");
    ply.add("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property list uchar int more\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
            "0 0 0 0\n1 0 0 1 7\n0 1 0 0\n3 0 1 2\n");
    stl.add(format_mesh(mesh, MeshFormat::stl));
    stl.add("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
            "endsolid s\n");
    test::GltfBuilder scene;
    scene.add_tetrahedron();
    gltf.add(scene.glb());
    gltf.add(scene.gltf(scene.data_uri()));
    gltf.add(full_scene().glb());
    gltf.add(avatar(vrm_1));
    gltf.add(avatar(vrm_0));
    const auto painted = painted_scene();
    gltf.add(painted.glb());
    gltf.add(painted.gltf(painted.data_uri()));

    Corpus any(folder, "mesh");
    for (const MeshFormat format :
         {MeshFormat::off, MeshFormat::obj, MeshFormat::ply, MeshFormat::stl, MeshFormat::glb})
        any.add(format_mesh(mesh, format));
#if SKELGEN_WITH_ZLIB
    write_mesh(folder / "mesh/compressed.off.gz", mesh);
#endif
    Corpus curve(folder, "curve");
    curve.add('\0' + curve_to_json(fork_curve()));
    curve.add('\1' + curve_to_obj(fork_curve()));
    curve.add('\2' + curve_to_ply(fork_curve()));
    curve.add('\3' + curve_to_swc(fork_curve()));
    Corpus bvh(folder, "bvh");
    bvh.add(clip_to_bvh(test::standing_clip()));
    bvh.add("HIERARCHY\nROOT a b{\nOFFSET 1 2 3\nCHANNELS 1 Yrotation\nEnd Site\n{ OFFSET 0 0 1 } }\n"
            "MOTION\nFrames: 2\nFrame Time: .1\n0\n90\n");
    Corpus clip(folder, "clip");
    clip.add(clip_to_bvh(test::standing_clip()));
    clip.add(full_scene().glb());
    clip.add(avatar(vrm_1));
    Corpus(folder, "template_json").add(template_to_json(builtin_template("pinocchio18")));
    Corpus(folder, "skeleton_json").add(skeleton_to_json(small_skeleton()));
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: skelgen-fuzz-corpus FOLDER\n";
        return 2;
    }
    try {
        make_corpus(argv[1]);
    } catch (const std::exception& error) {
        std::cerr << "skelgen-fuzz-corpus: " << error.what() << '\n';
        return 1;
    }
}
