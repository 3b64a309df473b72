// align, segment and measure as they are typed.

#include <algorithm>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/transform_json.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "json_schema.hpp"
#include "mesh_changes.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::test;
namespace fs = std::filesystem;

const std::string sample_body = SKELGEN_DATA "/sample/body.off";

std::string faults_of(const std::string& json, const std::string& schema) {
    return schema_faults(nlohmann::json::parse(json), SKELGEN_DATA "/schema/" + schema + ".schema.json");
}

TEST_CASE("align: bodies turned at random come to lie on each other", "[cli][align]") {
    const TemporaryFolder folder;
    const TriangleMesh<double> mesh = read_mesh(sample_body);
    fs::create_directory(folder / "in");
    write_mesh(folder / "in/a.off", mesh);
    write_mesh(folder / "in/b.ply", moved(mesh, {random_rotation(9), 100, Vector3<double>(1, 2, 3)}));
    const CliResult result = run_cli(folder.path(), {"align", "in", "-o", "out", "--scale", "--origin", "floor"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    CHECK(result.out.empty());
    const auto a = read_mesh(folder / "out/a.off"), b = read_mesh(folder / "out/b.ply");
    CHECK((a.vertices - b.vertices).cwiseAbs().maxCoeff() < 1e-6);
    CHECK(a.faces == mesh.faces);
    CHECK(a.vertices.col(1).minCoeff() == Approx(0).margin(1e-9));
    CHECK(a.vertices.col(1).maxCoeff() == Approx(1).margin(0.05)); // he strides: a little less than upright
    CHECK(core::enclosed_volume(a) > 0);

    const std::string text = test::read_file(folder / "out/b.transform.json");
    CHECK(faults_of(text, "transform").empty());
    const Eigen::Matrix4d transform = io::parse_transform(text);
    const auto source = read_mesh(folder / "in/b.ply");
    const Points<double> again = (source.vertices * transform.topLeftCorner<3, 3>().transpose()).rowwise() +
                                 transform.topRightCorner<3, 1>().transpose();
    CHECK((again - b.vertices).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("align: what goes wrong with one of many costs that one alone", "[cli][align]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "in");
    fs::copy_file(sample_body, folder / "in/body.off");
    test::write_file(folder / "in/sphere.off", sphere_off());
    const CliResult many = run_cli(folder.path(), {"align", "in", "-o", "out"});
    CHECK(many.status == 5);
    CHECK_THAT(many.err, Catch::Matchers::Contains("sphere.off: "));
    CHECK(files_below(folder / "out") == std::vector<std::string>{"body.off", "body.transform.json"});
    CHECK(run_cli(folder.path(), {"align", "in/sphere.off", "-o", "one"}).status == 4);
    CHECK(run_cli(folder.path(), {"align", "in/missing.off", "-o", "one"}).status == 3);
    CHECK(run_cli(folder.path(), {"align", "in/body.off"}).status == 2);
    CHECK(run_cli(folder.path(), {"align", "in/body.off", "-o", "in"}).status == 2); // would replace the input
    CHECK(run_cli(folder.path(), {"align", "in/body.off", "-o", "out", "--origin", "moon"}).status == 2);
}

TEST_CASE("transform files: what is no transform is refused", "[cli][align]") {
    for (const std::string text :
         {"[]", "{}", R"({"format": "skelgen-skeleton", "version": 1})",
          R"({"format": "skelgen-transform", "version": 2})",
          R"({"format": "skelgen-transform", "version": 1, "matrix": [[1, 2], [3, 4]]})",
          R"({"format": "skelgen-transform", "version": 1, "matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,"x"]]})"})
        CHECK_THROWS_AS(io::parse_transform(text), Error);
}

TEST_CASE("segment: JSON, coloured PLY, and a folder of both", "[cli][segment]") {
    const TemporaryFolder folder;
    fs::copy_file(sample_body, folder / "body.off");
    const CliResult printed = run_cli(folder.path(), {"segment", "body.off", "--parts", "body"});
    REQUIRE(printed.status == 0);
    CHECK(faults_of(printed.out, "segmentation").empty());
    const auto json = nlohmann::json::parse(printed.out);
    CHECK(json.at("parts").size() == 14);
    CHECK(json.at("vertex_part").size() == json.at("mesh").at("vertices"));
    CHECK(json.at("face_part").size() == json.at("mesh").at("faces"));
    const int most = *std::max_element(json.at("vertex_part").begin(), json.at("vertex_part").end());
    CHECK(most == 13);

    REQUIRE(run_cli(folder.path(), {"segment", "body.off", "-o", "parts.ply"}).status == 0);
    const std::string ply = test::read_file(folder / "parts.ply");
    CHECK_THAT(ply.substr(0, 400),
               Catch::Matchers::Contains("property uchar red") && Catch::Matchers::Contains("property int label"));
    const auto mesh = read_mesh(folder / "body.off"), back = read_mesh(folder / "parts.ply");
    CHECK(back.vertices == mesh.vertices);
    CHECK(back.faces == mesh.faces);

    REQUIRE(run_cli(folder.path(), {"segment", "body.off", "-o", "parts"}).status == 0);
    CHECK(files_below(folder / "parts") == std::vector<std::string>{"body.json", "body.ply"});
    CHECK(run_cli(folder.path(), {"segment", "body.off", "parts.ply", "-o", "x.json"}).status == 2);
    CHECK(run_cli(folder.path(), {"segment", "body.off", "--parts", "bits"}).status == 2);
    test::write_file(folder / "sphere.off", sphere_off());
    CHECK(run_cli(folder.path(), {"segment", "sphere.off", "-o", "s.json"}).status == 4);
    CHECK_FALSE(fs::exists(folder / "s.json"));
}

TEST_CASE("measure: JSON and CSV", "[cli][measure]") {
    const TemporaryFolder folder;
    fs::copy_file(sample_body, folder / "body.off");
    const CliResult printed = run_cli(folder.path(), {"measure", "body.off"});
    REQUIRE(printed.status == 0);
    CHECK(faults_of(printed.out, "measurements").empty());
    const auto json = nlohmann::json::parse(printed.out);
    REQUIRE(json.at("bodies").size() == 1);
    const double height = json.at("bodies").at(0).at("height");
    CHECK(json.at("bodies").at(0).at("unit").at("name") == "m");
    CHECK(json.at("bodies").at(0).at("girth_places").at("waist").at("normal").size() == 3);
    TriangleMesh<double> unknown = read_mesh(folder / "body.off");
    unknown.vertices *= 7;
    write_mesh(folder / "unknown.off", unknown);
    CHECK(nlohmann::json::parse(run_cli(folder.path(), {"measure", "unknown.off"}).out)
              .at("bodies")
              .at(0)
              .at("unit")
              .is_null());

    test::write_file(folder / "sphere.off", sphere_off());
    CHECK(run_cli(folder.path(), {"measure", "body.off", "sphere.off", "-o", "people.csv"}).status == 5);
    const std::string csv = test::read_file(folder / "people.csv");
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 2); // names and the one body
    CHECK(csv.rfind("file,sides_confidence,height,", 0) == 0);
    CHECK_THAT(csv, Catch::Matchers::Contains("\"body.off\","));
    const std::string line = csv.substr(csv.find('\n') + 1), names = csv.substr(0, csv.find('\n'));
    CHECK(std::count(line.begin(), line.end(), ',') == std::count(names.begin(), names.end(), ','));
    const std::size_t second = line.find(',', line.find(',') + 1);
    CHECK(std::stod(line.substr(second + 1)) == Approx(height).epsilon(1e-12));
    CHECK(run_cli(folder.path(), {"measure", "sphere.off"}).status == 4);
    CHECK(run_cli(folder.path(), {"measure", "body.off", "-o", "body.off"}).status == 2);
}

TEST_CASE("correspond: a vertex of the one body for each of the other", "[cli][correspond]") {
    const TemporaryFolder folder;
    const TriangleMesh<double> mesh = read_mesh(sample_body);
    write_mesh(folder / "a.off", mesh);
    write_mesh(folder / "b.ply", moved(mesh, {random_rotation(2), 3, Vector3<double>(1, 2, 3)}));
    const CliResult result = run_cli(folder.path(), {"correspond", "a.off", "b.ply", "-o", "map.json", "--ply",
                                                     "coloured", "--confidence", "--places"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    const std::string text = test::read_file(folder / "map.json");
    CHECK(faults_of(text, "correspondence").empty());
    const auto json = nlohmann::json::parse(text);
    const std::vector<int> map = json.at("vertex_to_vertex");
    REQUIRE(map.size() == static_cast<std::size_t>(mesh.vertices.rows()));
    CHECK(json.at("confidence").size() == map.size());
    CHECK(json.at("landmarks").size() == 19);
    double sum = 0;
    for (std::size_t v = 0; v < map.size(); ++v)
        sum += (mesh.vertices.row(static_cast<Eigen::Index>(v)) - mesh.vertices.row(map[v])).norm();
    CHECK(sum / static_cast<double>(map.size()) < 0.002);
    CHECK(files_below(folder / "coloured") == std::vector<std::string>{"from.ply", "to.ply"});
    CHECK(read_mesh(folder / "coloured/from.ply").vertices == mesh.vertices);

    write_mesh(folder / "c.ply", mesh);
    REQUIRE(run_cli(folder.path(), {"correspond", "a.off", "b.ply", "c.ply", "-o", "maps", "--ply", "many",
                                    "--confidence", "--places"})
                .status == 0);
    CHECK(files_below(folder / "maps") == std::vector<std::string>{"b.json", "c.json"});
    CHECK(test::read_file(folder / "maps/b.json") == text);
    CHECK(test::read_file(folder / "many/b/to.ply") == test::read_file(folder / "coloured/to.ply"));
    CHECK(run_cli(folder.path(), {"correspond", "a.off", "b.ply", "c.ply", "-o", "maps.json"}).status == 2);

    test::write_file(folder / "sphere.off", sphere_off());
    CHECK(run_cli(folder.path(), {"correspond", "a.off", "sphere.off", "-o", "x.json"}).status == 4);
    CHECK(run_cli(folder.path(), {"correspond", "a.off", "missing.off", "-o", "x.json"}).status == 3);
    CHECK(run_cli(folder.path(), {"correspond", "a.off"}).status == 2);
    CHECK(run_cli(folder.path(), {"correspond", "a.off", "b.ply", "-o", "b.ply"}).status == 2);
    CHECK_FALSE(fs::exists(folder / "x.json"));
}

TEST_CASE("measure, align, segment, correspond: of several bodies one, or each",
          "[cli][align][correspond][measure][segment]") {
    const TemporaryFolder folder;
    const TriangleMesh<double> mesh = read_mesh(sample_body);
    const auto n = mesh.vertices.rows();
    TriangleMesh<double> small{0.8 * mesh.vertices, mesh.faces};
    small.vertices.col(0).array() += 3;
    const TriangleMesh<double> two = side_by_side(mesh, small);
    fs::create_directory(folder / "in");
    write_mesh(folder / "in/two.off", two);
    fs::copy_file(sample_body, folder / "in/one.off");
    const auto run = [&](const std::vector<std::string>& arguments) {
        const CliResult result = run_cli(folder.path(), arguments);
        INFO(result.err);
        REQUIRE(result.status == 0);
        return result.out;
    };

    SECTION("measure") {
        const auto bodies_of = [&](const std::string& component, const std::string& mesh_or_folder) {
            return nlohmann::json::parse(run({"measure", mesh_or_folder, "--component", component})).at("bodies");
        };
        const auto all = bodies_of("all", "in");
        REQUIRE(all.size() == 3);
        std::vector<std::string> files;
        for (const auto& body : all) files.push_back(body.at("mesh").at("file"));
        CHECK(files == std::vector<std::string>{"one.off", "two.off.1", "two.off.2"});
        const auto height = [](const nlohmann::json& body) { return body.at("height").get<double>(); };
        CHECK(height(all[1]) == Approx(height(all[0])).epsilon(1e-6));
        CHECK(height(all[2]) == Approx(0.8 * height(all[0])).epsilon(1e-6));
        CHECK(height(bodies_of("2", "in/two.off")[0]) == height(all[2]));
    }
    SECTION("align: the one body alone, on the floor") {
        run({"align", "in", "--component", "all", "--origin", "floor", "-o", "out"});
        CHECK(files_below(folder / "out") == std::vector<std::string>{"one.off", "one.transform.json", "two.1.off",
                                                                      "two.1.transform.json", "two.2.off",
                                                                      "two.2.transform.json"});
        const auto second = read_mesh(folder / "out/two.2.off");
        CHECK(second.faces == mesh.faces);
        CHECK((second.vertices - 0.8 * read_mesh(folder / "out/two.1.off").vertices).cwiseAbs().maxCoeff() < 1e-6);
        CHECK(second.vertices.col(1).minCoeff() == Approx(0).margin(1e-9));
        run({"align", "in/two.off", "--component", "2", "--origin", "floor", "-o", "second"});
        CHECK(files_below(folder / "second") == std::vector<std::string>{"two.off", "two.transform.json"});
        CHECK(test::read_file(folder / "second/two.off") == test::read_file(folder / "out/two.2.off"));
    }
    SECTION("segment: for each vertex of the mesh") {
        run({"segment", "in/two.off", "--component", "all", "-o", "parts"});
        CHECK(files_below(folder / "parts") ==
              std::vector<std::string>{"two.1.json", "two.1.ply", "two.2.json", "two.2.ply"});
        const auto parts_of = [](const std::string& json) {
            return nlohmann::json::parse(json).at("vertex_part").get<std::vector<int>>();
        };
        const auto whole = parts_of(run({"segment", "in/one.off"}));
        const auto second = parts_of(test::read_file(folder / "parts/two.2.json"));
        REQUIRE(second.size() == 2 * whole.size());
        CHECK(std::equal(whole.begin(), whole.end(), second.begin() + n));
        CHECK(parts_of(run({"segment", "in/two.off", "--component", "2"})) == second);
        CHECK(run_cli(folder.path(), {"segment", "in/two.off", "--component", "all", "-o", "x.json"}).status == 2);
    }
    SECTION("correspond") {
        run({"correspond", "in/two.off", "in/two.off", "--from-component", "2", "--component", "all", "--places", "-o",
             "maps/"});
        CHECK(files_below(folder / "maps") == std::vector<std::string>{"two.1.json", "two.2.json"});
        for (const int number : {1, 2}) {
            const auto json =
                nlohmann::json::parse(test::read_file(folder / ("maps/two." + std::to_string(number) + ".json")));
            const std::vector<int> map = json.at("vertex_to_vertex");
            REQUIRE(map.size() == static_cast<std::size_t>(2 * n));
            double sum = 0;
            for (Eigen::Index v = 0; v < n; ++v) {
                const auto to = map[static_cast<std::size_t>(n + v)] - (number - 1) * n;
                REQUIRE((to >= 0 && to < n));
                sum += (mesh.vertices.row(v) - mesh.vertices.row(to)).norm();
            }
            CHECK(sum / static_cast<double>(n) < 0.002);
            for (const int face : json.at("vertex_to_face")) REQUIRE(face / mesh.faces.rows() == number - 1);
            for (const auto& landmark : json.at("landmarks")) {
                CHECK(landmark.at("from").get<int>() >= n);
                CHECK(landmark.at("to").get<int>() / n == number - 1);
            }
        }
    }
    SECTION("what cannot be") {
        const CliResult none = run_cli(folder.path(), {"measure", "in/two.off", "--component", "3"});
        CHECK(none.status == 2);
        CHECK_THAT(none.err, Catch::Matchers::Contains("there is no body number 3, only 2"));
        CHECK(run_cli(folder.path(), {"measure", "in/two.off"}).status == 4);
        for (const std::string component : {"0", "both", "1001", "-1"})
            CHECK(run_cli(folder.path(), {"measure", "in/two.off", "--component", component}).status == 2);
        for (const std::string command : {"extract", "rig", "animate", "pose"}) {
            const CliResult refused = run_cli(folder.path(), {command, "in/two.off", "--component", "all"});
            CHECK(refused.status == 2);
            CHECK_THAT(refused.err,
                       Catch::Matchers::Contains("what is written is of one body; take each by its number"));
        }
        fs::copy_file(sample_body, folder / "in/two.2.off");
        const CliResult both = run_cli(folder.path(), {"align", "in", "--component", "all", "-o", "out"});
        CHECK(both.status == 2);
        CHECK_THAT(both.err, Catch::Matchers::Contains("would be written there"));
    }
}

} // namespace
