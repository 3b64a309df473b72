#include <string>

#include <nlohmann/json.hpp>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/view_page.hpp>

#include "catch.hpp"
#include "io/base64.hpp"
#include "io/data_uri.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;

/// A box with the skeleton of human21's rest pose, given in another unit and place than the rig's.
io::ViewedBody small_body() {
    const SkeletonTemplate& human = builtin_template("human21");
    const Eigen::AngleAxisd turn(1.2, Eigen::Vector3d(1, 2, 3).normalized());
    io::ViewedBody body;
    body.name = "a<b>.off";
    body.rig.mesh = test::box({0.2, 1.7, 0.3}, 2);
    const auto vertices = body.rig.mesh.vertices.rows();
    body.rig.skin.joints.setZero(vertices, 4);
    body.rig.skin.weights.setZero(vertices, 4);
    body.rig.skin.weights.col(0).setOnes();
    body.skeleton.template_name = "human21";
    for (const TemplateJoint& joint : human.joints) {
        body.rig.joints.push_back({joint.name, joint.parent, joint.role, joint.side, joint.position,
                                   joint.tip ? *joint.tip : joint.position, Eigen::Quaterniond::Identity()});
        body.skeleton.joints.push_back(
            {joint.name, joint.parent, 100 * (turn * joint.position) + Eigen::Vector3d(7, 8, 9), 0.1, 0.5});
    }
    body.skeleton.frame.up = turn * Eigen::Vector3d::UnitY();
    body.curve.nodes.resize(2, 3);
    for (const int i : {0, 1})
        body.curve.nodes.row(i) = body.skeleton.joints[static_cast<std::size_t>(i)].position.transpose();
    body.curve.edges = {{0, 1}};
    body.curve.regions = {{0, 1}, {}};
    body.sections = {{3, {body.skeleton.joints[3].position}}};
    body.skeleton.quality.warnings = {"told"};
    return body;
}

TEST_CASE("base64: the vectors of RFC 4648, and all bytes", "[io][view]") {
    const std::string text = "foobar";
    const std::array<const char*, 7> encoded{"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    for (std::size_t n = 0; n <= text.size(); ++n) CHECK(io::detail::encode_base64(text.substr(0, n)) == encoded[n]);
    std::string bytes;
    for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
    CHECK(io::detail::decode_data_uri("data:;base64," + io::detail::encode_base64(bytes)) == bytes);
}

TEST_CASE("a viewed body: the rig as GLB, and all else in its coordinates", "[io][view]") {
    const io::ViewedBody body = small_body();
    const auto json = nlohmann::json::parse(io::viewed_body_to_json(body));
    CHECK(json.at("name") == "a<b>.off");
    CHECK(json.at("warnings").at(0) == "told");
    CHECK(json.at("has_looks") == false);
    REQUIRE(json.at("joints").size() == 21);
    CHECK(json.at("joints").at(3).at("name") == body.rig.joints[3].name);
    CHECK(json.at("joints").at(3).at("confidence") == 0.5);

    const double step = json.at("step");
    const auto lies_at = [&](const nlohmann::json& steps, const Eigen::Vector3d& place) {
        for (int axis = 0; axis < 3; ++axis)
            CHECK(step * steps.at(static_cast<std::size_t>(axis)).get<double>() ==
                  Approx(place[axis]).margin(0.51 * step));
    };
    for (const std::size_t i : {0U, 1U}) lies_at(json.at("curve").at("nodes").at(i), body.rig.joints[i].position);
    lies_at(json.at("sections").at(0).at("points").at(0), body.rig.joints[3].position);
    lies_at(json.at("joints").at(4).at("end"), body.rig.joints[4].end);
    CHECK(json.at("frame").at("up").at(1) == Approx(1));
    CHECK(json.at("curve").at("weights").at(1).at(0) == 1);

    const auto skeleton = io::parse_skeleton_document(json.at("skeleton").dump()).skeleton;
    REQUIRE(skeleton.joints.size() == 21);
    CHECK(skeleton.joints[5].position == body.skeleton.joints[5].position);
    for (std::size_t row = 0; row < 3; ++row) { // leads from the rig back to where the skeleton is
        const auto& to_input = json.at("to_input").at(row);
        double x = to_input.at(3);
        for (std::size_t i = 0; i < 3; ++i)
            x += to_input.at(i).get<double>() * body.rig.joints[7].position[static_cast<Eigen::Index>(i)];
        CHECK(x == Approx(body.skeleton.joints[7].position[static_cast<Eigen::Index>(row)]));
    }

    const auto glb = io::detail::decode_data_uri("data:;base64," + json.at("glb").get<std::string>());
    REQUIRE(glb);
    const auto mesh = io::parse_mesh<double>(*glb);
    CHECK((mesh.vertices - body.rig.mesh.vertices).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("a viewed body: bones of digits lie behind the skeleton's joints, with their own confidence", "[io][view]") {
    io::ViewedBody body = small_body();
    auto digit = body.rig.joints.back();
    digit.name = "left_toe1_1";
    digit.confidence = 0.25;
    body.rig.joints.push_back(digit);
    const auto json = nlohmann::json::parse(io::viewed_body_to_json(body));
    REQUIRE(json.at("joints").size() == 22);
    CHECK(json.at("joints").at(21).at("name") == "left_toe1_1");
    CHECK(json.at("joints").at(21).at("confidence") == 0.25);
    CHECK(json.at("joints").at(20).at("confidence") == 0.5);
    CHECK(json.at("skeleton").at("joints").size() == 21);
}

TEST_CASE("a viewed body: materials and animations go along", "[io][view]") {
    io::ViewedBody body = small_body();
    const auto vertices = body.rig.mesh.vertices.rows(), faces = body.rig.mesh.faces.rows();
    body.looks.parts = {{0, vertices, 0, faces, 0, {}}};
    body.looks.json = R"({"materials": [{"name": "paint"}]})";
    applications::RigPose<double> pose;
    pose.axes.assign(21, Eigen::Quaterniond::Identity());
    body.animations = {{"nod", 0.1, {pose, pose}}};
    const auto json = nlohmann::json::parse(io::viewed_body_to_json(body));
    CHECK(json.at("has_looks") == true);
    const auto glb = io::detail::decode_data_uri("data:;base64," + json.at("glb").get<std::string>());
    REQUIRE(glb);
    CHECK(glb->find("\"paint\"") != std::string::npos);
    CHECK(glb->find("\"nod\"") != std::string::npos);
}

TEST_CASE("a viewed body: a rig in another pose or of another skeleton is refused", "[io][view]") {
    io::ViewedBody body = small_body();
    body.skeleton.joints[5].position *= 1.1;
    CHECK_THROWS_AS(io::viewed_body_to_json(body), Error);
    body = small_body();
    body.rig.joints.pop_back();
    CHECK_THROWS_AS(io::viewed_body_to_json(body), Error);
}

TEST_CASE("a page: bodies in their element, whatever their names hold", "[io][view]") {
    const std::string before = "<!doctype html><script id=\"bodies\" type=\"application/json\">", after = "</script>";
    const std::vector<std::string> bodies{io::viewed_body_to_json(small_body()),
                                          io::refused_body_to_json("</script>", "why\n<b>", {}),
                                          io::refused_body_to_json("cube.off", "why", test::box({1, 1, 1}, 1))};
    const std::string page = io::view_page(before + after, bodies);
    REQUIRE(page.rfind(before, 0) == 0);
    const std::string json = page.substr(before.size(), page.size() - before.size() - after.size());
    CHECK(json.find('<') == std::string::npos);
    const auto parsed = nlohmann::json::parse(json);
    REQUIRE(parsed.size() == 3);
    CHECK(parsed.at(0).at("name") == "a<b>.off");
    CHECK(parsed.at(1).at("name") == "</script>");
    CHECK(parsed.at(1).at("failure") == "why\n<b>");
    CHECK_FALSE(parsed.at(1).contains("glb"));
    CHECK(parsed.at(2).contains("glb"));
    CHECK(io::view_page(before + after, {}) == before + "[]" + after);
    CHECK_THROWS_AS(io::view_page("<html></html>", bodies), Error);
}

} // namespace
