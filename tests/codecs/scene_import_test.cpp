#include <cmath>
#include <string>

#include <sys/resource.h>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "catch.hpp"
#include "io/fbx_names.hpp"
#include "io/mesh_expectations.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;

#if SKELGEN_WITH_ASSIMP

namespace {

void replace(std::string& text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    text.replace(at, what.size(), with);
}

/// A square pyramid: a quad, with its corners clockwise seen from above, and four triangles.
std::string collada(const std::string& scene_nodes, const std::string& libraries = "") {
    return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="metre" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="15">0 0 0 1 0 0 1 0 -1 0 0 -1 0.5 2 -0.5</float_array>
<technique_common><accessor source="#pa" count="5" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="5"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4 3 3 3 3</vcount>
<p>0 3 2 1 0 1 4 1 2 4 2 3 4 3 0 4</p></polylist></mesh></geometry></library_geometries>)" +
           libraries + R"(<library_visual_scenes><visual_scene id="s">)" + scene_nodes +
           R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

/// Highest point of a mesh.
Eigen::RowVector3d apex(const TriangleMesh<double>& mesh) {
    Eigen::Index row = 0;
    mesh.vertices.col(1).maxCoeff(&row);
    return mesh.vertices.row(row);
}

/// The tetrahedron as FBX in text.
std::string fbx() {
    return R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "",1
		P: "UnitScaleFactor", "double", "Number", "",1
	}
}
Objects:  {
	Geometry: 100, "Geometry::body", "Mesh" {
		Vertices: *12 {
			a: 0,0,0,1,0,0,0,1,0,0,0,1
		}
		PolygonVertexIndex: *12 {
			a: 0,2,-2,0,1,-4,0,3,-3,1,2,-4
		}
		GeometryVersion: 124
	}
	Model: 200, "Model::body", "Mesh" {
		Version: 232
		Properties70:  {
			P: "Lcl Translation", "Lcl Translation", "", "A",10,0,0
			P: "Lcl Scaling", "Lcl Scaling", "", "A",2,2,2
		}
	}
}
Connections:  {
	C: "OO",200,0
	C: "OO",100,200
}
)";
}

} // namespace

TEST_CASE("DAE: polygons, moved by their nodes", "[codecs][dae]") {
    const std::string instance = R"(<instance_geometry url="#g"/>)";
    const auto still = parse_mesh(collada("<node>" + instance + "</node>"));
    CHECK(still.vertices.rows() == 5);
    CHECK(still.faces.rows() == 6); // the quad is two
    CHECK((apex(still) - Eigen::RowVector3d(0.5, 2, -0.5)).norm() < 1e-6);

    const auto moved = parse_mesh(collada("<node><translate>5 0 0</translate><node><scale>1 3 1</scale>" + instance +
                                          "</node><node>" + instance + "</node></node>"));
    CHECK(moved.faces.rows() == 12);
    CHECK((apex(moved) - Eigen::RowVector3d(5.5, 6, -0.5)).norm() < 1e-6);
}

TEST_CASE("DAE: skins bend as their joints do, stored or animated", "[codecs][dae]") {
    // The ground belongs to the root, the tip to a joint at height 1, which is turned a quarter about z.
    const std::string libraries = R"(<library_controllers><controller id="c"><skin source="#g">
<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
<source id="j"><Name_array id="ja" count="2">root top</Name_array><technique_common><accessor source="#ja" count="2">
<param name="JOINT" type="name"/></accessor></technique_common></source>
<source id="b"><float_array id="ba" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 0 1 0 -1 0 0 1 0 0 0 0 1</float_array>
<technique_common><accessor source="#ba" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor>
</technique_common></source>
<source id="w"><float_array id="wa" count="1">1</float_array><technique_common><accessor source="#wa" count="1">
<param name="WEIGHT" type="float"/></accessor></technique_common></source>
<joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#b"/></joints>
<vertex_weights count="5"><input semantic="JOINT" source="#j" offset="0"/><input semantic="WEIGHT" source="#w" offset="1"/>
<vcount>1 1 1 1 1</vcount><v>0 0 0 0 0 0 0 0 1 0</v></vertex_weights></skin></controller></library_controllers>
<library_animations><animation id="turn">
<source id="t"><float_array id="ta" count="2">0 2</float_array><technique_common><accessor source="#ta" count="2">
<param name="TIME" type="float"/></accessor></technique_common></source>
<source id="a"><float_array id="aa" count="2">0 90</float_array><technique_common><accessor source="#aa" count="2">
<param name="ANGLE" type="float"/></accessor></technique_common></source>
<source id="i"><Name_array id="ia" count="2">LINEAR LINEAR</Name_array><technique_common><accessor source="#ia" count="2">
<param name="INTERPOLATION" type="name"/></accessor></technique_common></source>
<sampler id="s1"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#a"/>
<input semantic="INTERPOLATION" source="#i"/></sampler>
<channel source="#s1" target="topnode/spin.ANGLE"/></animation></library_animations>)";
    const std::string nodes =
        R"(<node id="rootnode" sid="root" type="JOINT"><node id="topnode" sid="top" type="JOINT">
<translate>0 1 0</translate><rotate sid="spin">0 0 1 90</rotate></node></node>
<node><instance_controller url="#c"><skeleton>#rootnode</skeleton></instance_controller></node>)";
    const std::string file = collada(nodes, libraries);
    const auto bent = parse_mesh(file);
    // The tip, one above the joint and half a unit beside it, comes to lie one beside it and half a unit above.
    CHECK((apex(bent) - Eigen::RowVector3d(-1, 1.5, -0.5)).norm() < 1e-6);

    const auto at = [&](double time) { return apex(parse_mesh(file, ReadMeshOptions{std::nullopt, "1", time})); };
    CHECK((at(0) - Eigen::RowVector3d(0.5, 2, -0.5)).norm() < 1e-6);
    CHECK((at(5) - Eigen::RowVector3d(-1, 1.5, -0.5)).norm() < 1e-6);
    const double half = std::sqrt(0.5); // the cosine and the sine of half the turn
    CHECK((at(1) - Eigen::RowVector3d(0.5 * half - half, 1 + 0.5 * half + half, -0.5)).norm() < 1e-3);
    CHECK_THROWS_AS(parse_mesh(file, ReadMeshOptions{std::nullopt, "jump", 0}), Error);
}

TEST_CASE("FBX: a mesh moved by its node", "[codecs][fbx]") {
    const auto mesh = parse_mesh(fbx());
    REQUIRE(mesh.vertices.rows() == 4);
    const auto expected = tetrahedron();
    for (int face = 0; face < 4; ++face)
        for (int k = 0; k < 3; ++k)
            CHECK((mesh.vertices.row(mesh.faces(face, k)) - 2 * expected.vertices.row(expected.faces(face, k)) -
                   Eigen::RowVector3d(10, 0, 0))
                      .norm() < 1e-6);
}

TEST_CASE("FBX: a number that is none costs its vertex, not the file, and that is told", "[codecs][fbx]") {
    std::string file = fbx();
    replace(file, "a: 0,0,0,1,0,0,0,1,0,0,0,1", "a: 0,0,0,1,0,0,0,1,0,0,0,nan");
    for (const bool isolated : {false, true}) {
        std::string told;
        ReadMeshOptions options{.isolated = isolated};
        options.tell = [&](const std::string& what) { told += what; };
        const auto mesh = parse_mesh(file, options);
        CHECK(mesh.faces.rows() == 1); // the one without that vertex
        CHECK(mesh.vertices.rows() == 3);
        CHECK(told == "3 corners without a finite place left out, with their faces");
    }
    replace(file, "a: 0,0,0,1,0,0,0,1,0,0,0,nan", "a: nan,0,0,nan,0,0,0,nan,0,0,0,nan");
    CHECK_THAT(reading_error(file), Catch::Matchers::Contains("no vertex at a finite place"));
}

TEST_CASE("FBX: versions that are too old are refused by their number, nodes that share a name are told apart",
          "[codecs][fbx]") {
    std::string old = fbx();
    replace(old, "FBXVersion: 7400", "FBXVersion: 6100");
    CHECK(detail::version_of_fbx(old) == 6100);
    CHECK_THAT(reading_error(old), Catch::Matchers::Contains("is FBX 6.1, and FBX is read from 7.1 on"));
    CHECK(detail::with_names_apart(old) == old);
    CHECK(detail::with_names_apart(fbx()) == fbx());
    std::string twice = fbx();
    replace(
        twice, "Model: 200",
        "Model: 201, \"Model::body\", \"Null\" {\n\t}\n\tModel: 202, \"Model::bod1\", \"Null\" {\n\t}\n\tModel: 200");
    const std::string apart = detail::with_names_apart(twice);
    CHECK(apart.size() == twice.size());
    CHECK(apart.find("201, \"Model::body\"") != std::string::npos);
    CHECK(apart.find("202, \"Model::bod1\"") != std::string::npos);
    CHECK(apart.find("200, \"Model::bod2\"") != std::string::npos);
    for (std::size_t size = 0; size < twice.size(); size += 11)
        CHECK(detail::with_names_apart(twice.substr(0, size)).size() == size);
}

TEST_CASE("FBX and DAE: no process is started but where the caller asks for one, and both ways read the same",
          "[codecs][fbx][dae]") {
    const auto faults_of_children = [] { // none, until one has ended
        ::rusage usage{};
        ::getrusage(RUSAGE_CHILDREN, &usage);
        return usage.ru_minflt;
    };
    for (const std::string& file : {collada(R"(<node><instance_geometry url="#g"/></node>)"), fbx()}) {
        const long before = faults_of_children();
        const TriangleMesh<double> here = parse_mesh(file);
        CHECK(faults_of_children() == before);
        const TriangleMesh<double> apart = parse_mesh(file, {.isolated = true});
        CHECK(faults_of_children() > before);
        CHECK(here.vertices == apart.vertices);
        CHECK(here.faces == apart.faces);
    }
}

TEST_CASE("FBX and DAE: damaged files are refused, whatever the library makes of them", "[codecs][fbx][dae]") {
    const auto survives = [](const std::string& bytes) {
        try {
            static_cast<void>(parse_mesh(bytes, {.isolated = true}));
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::bad_input);
            CHECK(std::string(error.what()).size() > 10);
        }
    };
    const std::string scene = collada(R"(<node><instance_geometry url="#g"/></node>)");
    for (const std::string& file : {scene, fbx()})
        for (std::size_t size = 10; size < file.size(); size += 37) survives(file.substr(0, size));
    std::string damaged = scene;
    replace(damaged, "0 3 2 1", "0 3 2 9");
    survives(damaged);
    damaged = scene;
    replace(damaged, "0.5 2 -0.5", "nan 2 -0.5");
    survives(damaged);
    damaged = fbx();
    replace(damaged, "1,2,-4", "1,2,-400");
    survives(damaged);
    CHECK_THAT(reading_error("no scene at all", MeshFormat::fbx), Catch::Matchers::Contains("export"));
    CHECK_THAT(reading_error(collada("<node/>")), Catch::Matchers::Contains("export"));
}

#endif
