#include "catch.hpp"

#include <limits>
#include <map>
#include <sstream>

#include <boost/property_tree/xml_parser.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/render/render_scene.hpp>

#include "scenes.hpp"

using namespace skelgen;
using namespace skelgen::render;
using namespace skelgen::test;

namespace {

RenderOptions square_picture(int size) {
    RenderOptions options;
    options.width = size;
    options.height = size;
    return options;
}

ErrorCode code_of(const Scene& scene, const RenderOptions& options) {
    try {
        (void)render_scene(scene, options);
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::internal;
}

/// Mean difference of two pictures' channels, 0 to 255.
double difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c) sum += std::abs(double(a.pixels[i][c]) - double(b.pixels[i][c]));
    return sum / (4.0 * static_cast<double>(a.pixels.size()));
}

} // namespace

TEST_CASE("a sphere is a disc that fills the picture's frame") {
    Scene scene;
    scene.mesh = sphere();
    RenderOptions options = square_picture(200);
    options.background = Background::transparent;
    const Image image = render_scene(scene, options);
    const double radius = (200 - 2 * 0.045 * 200) / 2;

    const Found body = find_pixels(image, [](const Pixel& p) { return p[3] > 127; });
    CHECK(body.count == Approx(std::numbers::pi * radius * radius).epsilon(0.01));
    CHECK(body.mean_x == Approx(99.5).margin(0.1));
    CHECK(image.at(100, 100 - int(radius) + 2)[3] > 127);
    CHECK(image.at(100, 100 - int(radius) - 3)[3] == 0);
}

TEST_CASE("the background is white or nothing at all") {
    Scene scene;
    scene.mesh = sphere(10);
    RenderOptions options = square_picture(64);
    CHECK(render_scene(scene, options).at(0, 0) == Pixel{255, 255, 255, 255});
    options.background = Background::transparent;
    CHECK(render_scene(scene, options).at(0, 0) == Pixel{0, 0, 0, 0});
}

TEST_CASE("bones are blue on the left, yellow on the right, and the front view is the viewer's") {
    Scene scene;
    scene.skeleton = small_skeleton();
    RenderOptions options = square_picture(200);
    SECTION("front: the person's left is on the viewer's right") {
        const Image image = render_scene(scene, options);
        CHECK(find_pixels(image, is_blue).count > 200);
        CHECK(find_pixels(image, is_blue).mean_x > 110);
        CHECK(find_pixels(image, is_yellow).count > 200);
        CHECK(find_pixels(image, is_yellow).mean_x < 90);
    }
    SECTION("back: the other way round") {
        options.view = NamedView::back;
        const Image image = render_scene(scene, options);
        CHECK(find_pixels(image, is_blue).mean_x < 90);
        CHECK(find_pixels(image, is_yellow).mean_x > 110);
    }
    SECTION("left bones stay blue inside a body") {
        scene.mesh = sphere();
        const Image image = render_scene(scene, options);
        CHECK(find_pixels(image, is_blue).mean_x > 110);
        CHECK(find_pixels(image, is_yellow).mean_x < 90);
    }
}

TEST_CASE("a joint that is missing is not drawn, nor is its bone") {
    Scene scene;
    scene.skeleton = small_skeleton();
    const RenderOptions options = square_picture(200);
    for (auto& joint : scene.skeleton->joints) joint.is_present = joint.name.rfind("left_", 0) != 0;
    scene.skeleton->end_points.clear();
    const Image image = render_scene(scene, options);
    CHECK(find_pixels(image, is_blue).count == 0);
    CHECK(find_pixels(image, is_yellow).count > 200);
}

TEST_CASE("a joint in front of the surface is bare, one behind it veiled") {
    Scene bare;
    bare.skeleton = small_skeleton();
    bare.mesh = plate(0);
    bare.mesh.faces.resize(0, 3); // keeps the fit of the picture, draws nothing
    Scene behind = bare;
    Scene in_front = bare;
    in_front.mesh = plate(-0.5);
    behind.mesh = plate(0.5);
    const RenderOptions options = square_picture(100);
    const Pixel colour = render_scene(bare, options).at(50, 50);
    CHECK(render_scene(in_front, options).at(50, 50) == colour);
    CHECK(render_scene(behind, options).at(50, 50) != colour);
}

TEST_CASE("the order of the faces makes no difference: the nearest surface wins") {
    Scene scene;
    TriangleMesh<double> tilted = plate(0);
    tilted.vertices.col(2) = 0.6 * tilted.vertices.col(0);
    tilted.vertices *= 0.5;
    scene.mesh = joined(plate(-2), tilted);
    const RenderOptions options = [] {
        RenderOptions o = square_picture(80);
        o.view = Vector3<double>::UnitZ();
        return o;
    }();
    const Image image = render_scene(scene, options);

    Scene reversed = scene;
    reversed.mesh.faces = scene.mesh.faces.colwise().reverse().eval();
    CHECK(render_scene(reversed, options).pixels == image.pixels);

    // Seen along z the tilted plate covers the middle; its shade differs from that of the plate behind it.
    CHECK(image.at(40, 40) != image.at(40, 8));
    Scene far_only;
    far_only.mesh = plate(-2);
    CHECK(render_scene(far_only, options).at(40, 40) != image.at(40, 40));
    CHECK(difference(image, render_scene(far_only, options)) > 1);
}

TEST_CASE("a picture does not depend on unit or place") {
    Scene scene;
    scene.mesh = sphere(20);
    scene.skeleton = small_skeleton();
    const RenderOptions options = square_picture(100);
    const Image image = render_scene(scene, options);
    for (const double scale : {1e-8, 1e8}) {
        const Eigen::RowVector3d shift = Eigen::RowVector3d(1, -2, 3) * scale;
        Scene moved = scene;
        moved.mesh.vertices = (scene.mesh.vertices * scale).rowwise() + shift;
        for (auto& joint : moved.skeleton->joints) joint.position = joint.position * scale + shift.transpose();
        CHECK(difference(render_scene(moved, options), image) < 0.1);
    }
}

TEST_CASE("the same scene gives the same pixels") {
    Scene scene;
    scene.mesh = sphere(20);
    scene.skeleton = small_skeleton();
    scene.caption = "twice";
    RenderOptions options = square_picture(120);
    options.names = true;
    CHECK(render_scene(scene, options).pixels == render_scene(scene, options).pixels);
    CHECK(render_svg(scene, options) == render_svg(scene, options));
}

TEST_CASE("supersampling smooths the edges") {
    Scene scene;
    scene.mesh = sphere(30);
    RenderOptions options = square_picture(64);
    options.background = Background::transparent;
    options.supersampling = 1;
    const auto half_covered = [](const Pixel& p) { return p[3] > 20 && p[3] < 150; };
    const int rough = find_pixels(render_scene(scene, options), half_covered).count;
    options.supersampling = 4;
    CHECK(find_pixels(render_scene(scene, options), half_covered).count > rough + 20);
}

TEST_CASE("marks are red crosses on top of everything") {
    Scene scene;
    scene.mesh = sphere(20);
    scene.marks = {{"knee", {0, 0, -1}}}; // on the far side
    RenderOptions options = square_picture(200);
    options.view = Vector3<double>::UnitZ();
    const Image image = render_scene(scene, options);
    CHECK(is_red(image.at(100, 100)));
    const int count = find_pixels(image, is_red).count;
    CHECK(count > 8);
    CHECK(count < 200);
}

TEST_CASE("a failure is framed and written in red, with or without a mesh") {
    Scene scene;
    const RenderOptions options = square_picture(200);
    CHECK(find_pixels(render_scene(scene, options), is_red).count == 0);
    scene.failure = "no skeleton: a sphere has no limbs";
    const int without_mesh = find_pixels(render_scene(scene, options), is_red).count;
    CHECK(without_mesh > 4 * 150);
    scene.mesh = sphere(10);
    CHECK(find_pixels(render_scene(scene, options), is_red).count > 4 * 150);
    scene.failure = "no";
    CHECK(find_pixels(render_scene(scene, options), is_red).count < without_mesh);
}

TEST_CASE("an SVG is well-formed and holds bones, names and captions as text") {
    Scene scene;
    scene.mesh = sphere(10);
    scene.skeleton = small_skeleton();
    scene.curve = CurveSkeleton<double>{Points<double>::Random(2, 3), {{0, 1}}, {}, {}};
    scene.marks = {{"knee", {0, 0, 0}}};
    scene.caption = "a<b & \"c\"";
    scene.failure = "because";
    RenderOptions options = square_picture(300);
    options.names = true;
    const std::string svg = render_svg(scene, options);

    std::istringstream stream(svg);
    boost::property_tree::ptree document;
    REQUIRE_NOTHROW(boost::property_tree::read_xml(stream, document));
    std::vector<std::string> texts;
    std::map<std::string, int> elements;
    for (const auto& [tag, element] : document.get_child("svg")) {
        ++elements[tag];
        if (tag == "text") texts.push_back(element.data());
    }
    CHECK(texts == std::vector<std::string>{"a<b & \"c\"", "because", "right_hand", "head", "root", "left_hand"});
    CHECK(elements["circle"] == 6); // joints, and the ends of the curve
    CHECK(elements["path"] == 4);   // bones and curve
    CHECK(elements["image"] == 1);
    CHECK(svg.find("href=\"data:image/png;base64,iVBORw0KGgo") != std::string::npos);

    options.names = false;
    CHECK(render_svg(scene, options).find("left_hand") == std::string::npos);
}

TEST_CASE("what cannot be drawn is refused") {
    const RenderOptions options = square_picture(64);
    Scene scene;
    scene.mesh = sphere(5);
    scene.skeleton = small_skeleton();
    const double nan = std::numeric_limits<double>::quiet_NaN();

    SECTION("a face without its vertex") { scene.mesh.faces(0, 0) = 1'000'000; }
    SECTION("a negative index") { scene.mesh.faces(0, 0) = -1; }
    SECTION("a coordinate that is no number") { scene.mesh.vertices(0, 0) = nan; }
    SECTION("a joint at infinity") { scene.skeleton->joints[0].position.x() = std::numeric_limits<double>::infinity(); }
    SECTION("a joint before its parent") { scene.skeleton->joints[0].parent = 2; }
    SECTION("an end point that is nowhere") { scene.skeleton->end_points = {{"left_toe", {nan, 0, 0}}}; }
    SECTION("a mark that is nowhere") { scene.marks = {{"m", {nan, 0, 0}}}; }
    SECTION("an edge of the curve to nowhere") {
        scene.curve = CurveSkeleton<double>{Points<double>::Zero(1, 3), {{0, 1}}, {}, {}};
    }
    CHECK(code_of(scene, options) == ErrorCode::bad_input);
}

TEST_CASE("options out of range are refused") {
    RenderOptions options = square_picture(64);
    SECTION("too small") { options.width = 15; }
    SECTION("too large") { options.height = 16385; }
    SECTION("no samples") { options.supersampling = 0; }
    SECTION("too many samples") { options.supersampling = 9; }
    CHECK(code_of({}, options) == ErrorCode::usage);
}

TEST_CASE("a scene of a single point, or of a flat one seen edge-on, is still a picture") {
    Scene scene;
    SECTION("one joint") {
        scene.skeleton = small_skeleton();
        scene.skeleton->joints.resize(1);
    }
    SECTION("a plate from the side") { scene.mesh = plate(0); }
    RenderOptions options = square_picture(64);
    options.view = Vector3<double>::UnitX();
    CHECK(render_scene(scene, options).pixels.size() == 64 * 64);
}

TEST_CASE("real bodies fill their picture") {
    const auto folder = bodies_folder();
    if (!folder) SKELGEN_SKIP("SKELGEN_BODIES does not name a folder of real bodies");
    Scene scene;
    scene.mesh = read_mesh<double>(*folder / "meshes/scape/mesh000.off");
    RenderOptions options;
    options.background = Background::transparent;
    const Image image = render_scene(scene, options);
    const double covered = find_pixels(image, [](const Pixel& p) { return p[3] > 0; }).count;
    CHECK(covered / double(image.pixels.size()) > 0.08);
    CHECK(covered / double(image.pixels.size()) < 0.5);
}
