#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/scene_looks.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "io/gltf_builder.hpp"
#include "run_cli.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::test;
namespace fs = std::filesystem;

TEST_CASE("rig: characters and skeletons, the input's vertices in their order", "[cli][rig]") {
    const TemporaryFolder folder;
    const CliResult as_is = run_cli(folder.path(), {"rig", sample_body, "-o", "body.glb"});
    INFO(as_is.err);
    REQUIRE(as_is.status == 0);
    CHECK((as_is.out + as_is.err).empty());
    const auto mesh = read_mesh(sample_body), bound = read_mesh(folder / "body.glb");
    CHECK(bound.faces == mesh.faces);
    CHECK((bound.vertices.row(0) - bound.vertices.row(99)).norm() ==
          Approx((mesh.vertices.row(0) - mesh.vertices.row(99)).norm()).epsilon(1e-5));

    REQUIRE(run_cli(folder.path(), {"rig", sample_body, "-o", "body.vrm"}).status == 0);
    const auto t_pose = read_mesh(folder / "body.vrm");
    const double width = t_pose.vertices.col(0).maxCoeff() - t_pose.vertices.col(0).minCoeff();
    const double height = t_pose.vertices.col(1).maxCoeff() - t_pose.vertices.col(1).minCoeff();
    CHECK(width / height > 0.9); // arms to the sides

    REQUIRE(run_cli(folder.path(), {"rig", sample_body, "-o", "body.BVH", "--names", "mixamo", "--rest", "a-pose"})
                .status == 0);
    CHECK(test::read_file(folder / "body.BVH").find("JOINT LeftForeArm") != std::string::npos);
}

TEST_CASE("rig and pose: a character without its pictures loses these alone, which is said", "[cli][rig][pose]") {
    const auto mesh = read_mesh(sample_body);
    GltfBuilder scene;
    scene.add_mesh(mesh);
    scene.primitive()["material"] = 0;
    scene.json["materials"] = {{{"name", "skin"}}};
    scene.json["images"] = {{{"uri", "missing.png"}}};
    const TemporaryFolder folder;
    test::write_file(folder / "character.glb", scene.glb());
    for (const auto& arguments :
         {std::vector<std::string>{"rig", "character.glb", "-o", "out.glb"},
          std::vector<std::string>{"pose", "character.glb", "--like", sample_body, "-o", "out.glb"}}) {
        const CliResult result = run_cli(folder.path(), arguments);
        INFO(result.err);
        CHECK(result.status == 0);
        CHECK(result.err.rfind("skelgen: warning: character.glb: 1 picture is left out: ", 0) == 0);
        CHECK(result.err.find("missing.png") != std::string::npos);
        CHECK(read_mesh(folder / "out.glb").faces == mesh.faces);
        CHECK(io::read_looks(folder / "out.glb")->json.find("skin") != std::string::npos);
    }
    const CliResult piped = run_shell(folder.path(), "$skelgen rig - -o out.glb < character.glb");
    CHECK(piped.status == 0);
    CHECK(piped.err.rfind("skelgen: warning: -: 1 picture is left out: ", 0) == 0);
    CHECK(io::read_looks(folder / "out.glb")->json.find("skin") != std::string::npos);
    const CliResult batch = run_cli(folder.path(), {"batch", "character.glb", "-o", "batch", "--also", "rig", "-q"});
    INFO(batch.err);
    CHECK(batch.status == 0);
    CHECK(test::read_file(folder / "batch/summary.jsonl").find("1 picture is left out: ") != std::string::npos);
}

TEST_CASE("rig and pose: one of several bodies comes without the others, with its own looks", "[cli][rig][pose]") {
    // The same man twice, the second one smaller, a step below and turned inside a scene that has a material for each.
    const auto mesh = read_mesh(sample_body);
    TriangleMesh<double> small = mesh;
    small.vertices = (0.8 * small.vertices).rowwise() + Eigen::RowVector3d(2, -3, 0.3);
    GltfBuilder scene;
    scene.add_tetrahedron();
    const auto primitive_of = [&](const TriangleMesh<double>& body, int material) {
        std::vector<float> coordinates;
        for (Eigen::Index v = 0; v < body.vertices.rows(); ++v) {
            coordinates.push_back(static_cast<float>(material));
            coordinates.push_back(static_cast<float>(v));
        }
        auto primitive = scene.primitive_of(body);
        primitive["attributes"]["TEXCOORD_0"] = scene.add("VEC2", coordinates);
        primitive["material"] = material;
        return primitive;
    };
    scene.json["meshes"][0]["primitives"] = {primitive_of(mesh, 0), primitive_of(small, 1)};
    scene.json["materials"] = {{{"name", "large"}}, {{"name", "small"}}};
    const TemporaryFolder folder;
    test::write_file(folder / "two.glb", scene.glb());
    for (const int number : {1, 2}) {
        const TriangleMesh<double>& wanted = number == 1 ? mesh : small;
        const std::string component = std::to_string(number);
        const auto is_alone = [&](const std::vector<std::string>& arguments) {
            const CliResult result = run_cli(folder.path(), arguments);
            INFO(result.err);
            REQUIRE(result.status == 0);
            const auto alone = read_mesh(folder / "out.glb");
            CHECK(alone.faces == mesh.faces);
            const auto looks = io::read_looks(folder / "out.glb");
            REQUIRE(looks);
            REQUIRE(looks->parts.size() == 1);
            CHECK(looks->parts[0].material == static_cast<std::size_t>(number - 1));
            REQUIRE(looks->parts[0].texture_coordinates.size() == 1);
            CHECK(looks->parts[0].texture_coordinates[0](7, 0) == static_cast<float>(number - 1));
            CHECK(looks->parts[0].texture_coordinates[0](7, 1) == 7);
            return alone;
        };
        const auto rig = is_alone({"rig", "two.glb", "-o", "out.glb", "--component", component, "--place", "centre"});
        CHECK(rig.vertices.col(1).minCoeff() == Approx(0).margin(1e-5));
        CHECK((rig.vertices.row(0) - rig.vertices.row(99)).norm() ==
              Approx((wanted.vertices.row(0) - wanted.vertices.row(99)).norm()).epsilon(1e-4));
        const auto held =
            is_alone({"pose", "two.glb", "--like", sample_body, "-o", "out.glb", "--component", component});
        CHECK((held.vertices.row(0) - held.vertices.row(99)).norm() ==
              Approx((wanted.vertices.row(0) - wanted.vertices.row(99)).norm()).epsilon(0.02));
    }
}

TEST_CASE("rig and pose: an OBJ keeps materials, texture coordinates and normals, its vertices come first",
          "[cli][rig][pose]") {
    // The same man twice. All vertices have two texture coordinates, one in the first half of the faces; all normals
    // are those of a faceted body, which no smooth one has.
    const auto mesh = read_mesh(sample_body);
    std::string obj = "mtllib missing paints.mtl\nvt 0 0\nvt 0.5 1\n";
    const auto add = [&](const std::string& start, const Eigen::RowVector3d& row) {
        obj += start;
        for (const double x : row) obj += ' ' + std::to_string(x);
        obj += '\n';
    };
    for (const double shift : {0.0, 3.0})
        for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
            add("v", (shift > 0 ? 0.8 : 1.0) * mesh.vertices.row(v) + Eigen::RowVector3d(shift, 0, 0));
    const auto corner = [&](Eigen::Index f, int k) { return mesh.vertices.row(mesh.faces(f, k)).head<3>(); };
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        add("vn", (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)).normalized());
    for (const Eigen::Index first : {Eigen::Index{0}, mesh.vertices.rows()}) {
        obj += first == 0 ? "usemtl large man\n" : "usemtl small man\n";
        for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
            obj += 'f';
            for (const int vertex : mesh.faces.row(f))
                obj += ' ' + std::to_string(first + vertex + 1) + (2 * f < mesh.faces.rows() ? "/1/" : "/2/") +
                       std::to_string(f + 1);
            obj += '\n';
        }
    }
    const TemporaryFolder folder;
    test::write_file(folder / "men.obj", obj);
    for (const auto& arguments :
         {std::vector<std::string>{"rig", "men.obj", "-o", "out.glb", "--component", "2"},
          std::vector<std::string>{"pose", "men.obj", "--like", sample_body, "-o", "out.glb", "--component", "2"}}) {
        const CliResult result = run_cli(folder.path(), arguments);
        INFO(result.err);
        REQUIRE(result.status == 0);
        CHECK(result.err.find("1 material or file of materials is left out: the scene's file 'missing paints.mtl'") !=
              std::string::npos);
        const auto out = read_mesh(folder / "out.glb");
        CHECK(out.faces.rows() == mesh.faces.rows());
        REQUIRE(out.vertices.rows() > mesh.vertices.rows());
        const auto size = [](const auto& of) { return (of.row(0) - of.row(99)).norm(); };
        CHECK(size(out.vertices) == Approx(0.8 * size(mesh.vertices)).epsilon(0.02));
        const auto looks = io::read_looks(folder / "out.glb");
        REQUIRE(looks);
        REQUIRE(looks->parts.size() == 1);
        const io::ScenePart& part = looks->parts[0];
        CHECK(looks->json.find("small man") != std::string::npos);
        CHECK(part.material == 1);
        REQUIRE(part.texture_coordinates.size() == 1);
        double away = 0;
        for (Eigen::Index f = 0; f < out.faces.rows(); ++f) {
            const auto place = [&](int k) { return out.vertices.row(out.faces(f, k)); };
            const Eigen::RowVector3d across =
                Eigen::RowVector3d(place(1) - place(0)).cross(Eigen::RowVector3d(place(2) - place(0))).normalized();
            for (const int v : out.faces.row(f)) {
                CHECK(part.texture_coordinates[0](v, 0) == (2 * f < out.faces.rows() ? 0.0F : 0.5F));
                away += (part.normals.row(v).cast<double>() - across).norm();
            }
        }
        CHECK(away / static_cast<double>(out.faces.size()) < 0.05); // bent a little where skin is
    }
}

/// The sample body as GLB: upright, facing +z but for `aside` degrees, somewhere in its scene, with a morph target on
/// its first hundred vertices that moves them up by a centimetre.
TriangleMesh<double> write_standing(const fs::path& file, double aside, double scale = 1) {
    const TemporaryFolder folder;
    const CliResult found = run_cli(folder.path(), {"extract", sample_body, "-q"});
    const nlohmann::json frame = nlohmann::json::parse(found.out).at("frame");
    const auto direction = [&](const char* name) -> Eigen::Vector3d {
        const auto& values = frame.at(name);
        return {values[0].get<double>(), values[1].get<double>(), values[2].get<double>()};
    };
    Eigen::Matrix3d turn;
    turn << direction("left").transpose(), direction("up").transpose(), direction("forward").transpose();
    const Eigen::AngleAxisd yaw(aside * 3.14159265 / 180, Eigen::Vector3d::UnitY());
    TriangleMesh<double> mesh = read_mesh(sample_body);
    mesh.vertices = scale * ((mesh.vertices * (yaw * turn).transpose()).rowwise() + Eigen::RowVector3d(3, 0.25, -2));
    GltfBuilder scene;
    scene.add_mesh(mesh);
    std::vector<float> offsets(static_cast<std::size_t>(mesh.vertices.size()), 0.0F);
    for (std::size_t v = 0; v < 100; ++v) offsets[3 * v + 1] = static_cast<float>(0.01 * scale);
    scene.primitive()["targets"] = {{{"POSITION", scene.add<float>("VEC3", offsets)}}};
    scene.json["meshes"][0]["extras"] = {{"targetNames", {"rise"}}};
    scene.json["nodes"][0]["name"] = "Man";
    scene.json["animations"] = GltfBuilder::Json::array({GltfBuilder::Json::object()});
    test::write_file(file, scene.glb());
    return read_mesh(file);
}

TEST_CASE("rig: what stands upright in its scene stays where it is, or goes where it is told to", "[cli][rig]") {
    const TemporaryFolder folder;
    const auto mesh = write_standing(folder / "man.glb", 8);
    const auto rigged = [&](std::vector<std::string> options) {
        for (const char* const first : {"out.glb", "-o", "man.glb", "rig"}) options.insert(options.begin(), first);
        const CliResult result = run_cli(folder.path(), options);
        INFO(result.err);
        REQUIRE(result.status == 0);
        CHECK(result.err.rfind("skelgen: warning: man.glb: left out: 1 animation\n", 0) == 0);
        return read_mesh(folder / "out.glb");
    };
    const auto kept = rigged({});
    CHECK((kept.vertices - mesh.vertices).cwiseAbs().maxCoeff() < 1e-5);
    const auto looks = io::read_looks(folder / "out.glb");
    REQUIRE(looks);
    REQUIRE(looks->objects.size() == 1);
    CHECK(looks->objects[0].name == "Man");
    CHECK(looks->objects[0].mesh_extras == R"({"targetNames":["rise"]})");
    REQUIRE(looks->objects[0].morphs.size() == 1);
    REQUIRE(looks->objects[0].morphs[0].vertices.size() == 100);
    CHECK((looks->objects[0].morphs[0].positions.rowwise() - Eigen::RowVector3f(0, 0.01F, 0)).norm() < 1e-5F);
    const auto on_floor = rigged({"--place", "floor"});
    Eigen::RowVector3d down(0, mesh.vertices.col(1).minCoeff(), 0);
    CHECK((on_floor.vertices - (mesh.vertices.rowwise() - down)).cwiseAbs().maxCoeff() < 1e-5);
    const auto centred = rigged({"--place", "centre"});
    const Eigen::RowVector3d way = mesh.vertices.row(0) - centred.vertices.row(0);
    CHECK(way[0] == Approx(3).margin(0.3));
    CHECK(way[2] == Approx(-2).margin(0.3));
    CHECK((centred.vertices - (mesh.vertices.rowwise() - way)).cwiseAbs().maxCoeff() < 1e-5);
    // In the T-pose soles stay on the floor that they were on.
    const auto t_pose = rigged({"--rest", "t-pose"});
    CHECK(t_pose.vertices.col(1).minCoeff() == Approx(mesh.vertices.col(1).minCoeff()).margin(1e-5));

    // In feet by its word; by its height it would be in metres.
    const auto in_feet = rigged({"--unit", "ft"});
    CHECK((in_feet.vertices - 0.3048 * mesh.vertices).cwiseAbs().maxCoeff() < 1e-4);
    static_cast<void>(write_standing(folder / "man.glb", -8, 100));
    const CliResult in_centimetres = run_cli(folder.path(), {"rig", "man.glb", "-o", "out.glb"});
    CHECK(in_centimetres.err.find("skelgen: note: man.glb: its unit is 0.01 m; what is written is in metres\n") !=
          std::string::npos);
    CHECK(run_cli(folder.path(), {"rig", "man.glb", "-o", "out.bvh"}).err.find("1 morph targets (BVH") !=
          std::string::npos);
}

TEST_CASE("rig: credits are written, and a licence's word is not lost under -q", "[cli][rig][vrm]") {
    const TemporaryFolder folder;
    REQUIRE(run_cli(folder.path(), {"rig", sample_body, "-o", "body.vrm", "--title", "Ada", "--author", "A",
                                    "--license", "https://example.org/free"})
                .status == 0);
    const std::string vrm = test::read_file(folder / "body.vrm");
    CHECK(vrm.find(R"("authors":["A"])") != std::string::npos);
    CHECK(vrm.find(R"("name":"Ada")") != std::string::npos);
    CHECK(vrm.find(R"("otherLicenseUrl":"https://example.org/free")") != std::string::npos);
    CHECK(vrm.find("unknown") == std::string::npos);
    // What has been written is a VRM that is silent about redistribution, but names a licence; then none.
    CHECK(run_cli(folder.path(), {"rig", "body.vrm", "-o", "again.vrm", "-q"}).err.empty());
    CHECK(test::read_file(folder / "again.vrm").find(R"("authors":["A"])") != std::string::npos);
    REQUIRE(run_cli(folder.path(), {"rig", sample_body, "-o", "silent.vrm"}).status == 0);
    const CliResult silent = run_cli(folder.path(), {"rig", "silent.vrm", "-o", "again.glb", "-q"});
    CHECK(silent.err.find("ITS LICENCE FORBIDS redistribution and modification") != std::string::npos);
}

TEST_CASE("rig, pose, segment and measure: a skeleton that is given is taken", "[cli][rig][pose]") {
    const TemporaryFolder folder;
    REQUIRE(run_cli(folder.path(), {"extract", sample_body, "-o", "found.json", "-q"}).status == 0);
    nlohmann::json skeleton = nlohmann::json::parse(test::read_file(folder / "found.json"));
    // The left elbow is put right by two centimetres.
    nlohmann::json& elbow = skeleton["joints"][6];
    REQUIRE(elbow["name"] == "left_elbow");
    elbow["position"][2] = elbow["position"][2].get<double>() + 0.02;
    test::write_file(folder / "mended.json", skeleton.dump());
    const auto way_of_elbow = [&](const std::string& file) {
        const CliResult result =
            run_cli(folder.path(), {"rig", sample_body, "-o", "out.bvh", "--skeleton", file, "--place", "centre"});
        INFO(result.err);
        REQUIRE(result.status == 0);
        const std::string bvh = test::read_file(folder / "out.bvh");
        const auto at = bvh.find("OFFSET", bvh.find("JOINT left_elbow"));
        std::istringstream numbers(bvh.substr(at + 6, 80));
        Eigen::Vector3d offset;
        numbers >> offset[0] >> offset[1] >> offset[2];
        return offset;
    };
    REQUIRE(run_cli(folder.path(), {"rig", sample_body, "-o", "out.bvh", "--place", "centre"}).status == 0);
    const std::string searched = test::read_file(folder / "out.bvh");
    const Eigen::Vector3d was = way_of_elbow("found.json");
    CHECK(test::read_file(folder / "out.bvh") == searched);                       // the same skeleton, the same rig
    CHECK((way_of_elbow("mended.json") - was).norm() == Approx(2).epsilon(0.01)); // centimetres
    for (const auto& arguments : {std::vector<std::string>{"pose", sample_body, "--pose", "found.json", "-o", "x.off"},
                                  std::vector<std::string>{"segment", sample_body, "-o", "x.json"},
                                  std::vector<std::string>{"measure", sample_body, "-o", "x.csv"}}) {
        std::vector<std::string> all = arguments;
        all.emplace_back("--skeleton");
        all.emplace_back("mended.json");
        const CliResult result = run_cli(folder.path(), all);
        INFO(result.err);
        CHECK(result.status == 0);
    }
    const CliResult several =
        run_cli(folder.path(), {"measure", sample_body, "found.json", "-o", "x.csv", "--skeleton", "mended.json"});
    CHECK(several.status == 2);
    for (nlohmann::json& joint : skeleton["joints"]) joint["position"][0] = joint["position"][0].get<double>() + 9;
    test::write_file(folder / "away.json", skeleton.dump());
    const CliResult away = run_cli(folder.path(), {"rig", sample_body, "-o", "x.glb", "--skeleton", "away.json"});
    CHECK(away.status == 3);
    CHECK(away.err.find("do not lie in the body") != std::string::npos);
}

TEST_CASE("rig: what cannot be done is one line and no file", "[cli][rig]") {
    const TemporaryFolder folder;
    write_mesh(folder / "capsule.off", capsule(0.2, 2));
    const auto fails = [&](const std::vector<std::string>& arguments, int status) {
        std::vector<std::string> all{"rig"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const CliResult result = run_cli(folder.path(), all);
        CHECK(result.status == status);
        CHECK(result.err.rfind("skelgen: error: ", 0) == 0);
        CHECK(result.err.find('\n') == result.err.size() - 1);
        CHECK(files_below(folder.path()) == std::vector<std::string>{"capsule.off"});
    };
    fails({"capsule.off", "-o", "x.glb"}, 4);
    fails({"missing.off", "-o", "x.glb"}, 3);
    fails({"capsule.off", "-o", "x.dae"}, 2);
    fails({"capsule.off"}, 2);
    fails({"capsule.off", "-o", "x.glb", "--names", "maya"}, 2);
    fails({"capsule.off", "-o", "x.vrm", "--rest", "a-pose"}, 2);
    fails({"capsule.off", "-o", "capsule.off"}, 2);
    fails({sample_body, "-o", "no/such/folder/x.glb"}, 2);
    const CliResult nowhere = run_cli(folder.path(), {"rig", sample_body, "-o", "no/such/folder/x.glb"});
    CHECK(nowhere.err.rfind("skelgen: error: no/such/folder/x.glb: cannot be written", 0) == 0); // it is not the mesh's
}

} // namespace
