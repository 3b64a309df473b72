#include "catch.hpp"
#include "json_schema.hpp"

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/io/read_file.hpp>
#include <skelgen/io/template_json.hpp>

namespace {

using namespace skelgen;
using namespace skelgen::io;
using nlohmann::json;
using Path = std::filesystem::path;

const Path data_folder = SKELGEN_DATA;

json load_json(const Path& file) { return json::parse(read_file(file)); }

json human21() { return load_json(data_folder / "templates/human21.json"); }

json& joint(json& document, const std::string& name) {
    const auto found = std::find_if(document["joints"].begin(), document["joints"].end(),
                                    [&](const json& j) { return j["name"] == name; });
    REQUIRE(found != document["joints"].end());
    return *found;
}

/// The message with which `text` is refused as bad input; empty when it is not.
std::string refusal(const std::string& text) {
    try {
        (void)parse_template(text);
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return {};
}

std::string refusal(const json& document) { return refusal(document.dump()); }

bool matches_schema(const json& document) {
    return test::schema_faults(document, data_folder / "schema/template.schema.json").empty();
}

void check_same(const SkeletonTemplate& a, const SkeletonTemplate& b) {
    CHECK(a.name == b.name);
    REQUIRE(a.joints.size() == b.joints.size());
    for (std::size_t i = 0; i < a.joints.size(); ++i) {
        INFO(a.joints[i].name);
        CHECK(a.joints[i].name == b.joints[i].name);
        CHECK(a.joints[i].parent == b.joints[i].parent);
        CHECK(a.joints[i].role == b.joints[i].role);
        CHECK(a.joints[i].side == b.joints[i].side);
        CHECK(a.joints[i].position == b.joints[i].position);
        CHECK(a.joints[i].radius == b.joints[i].radius);
        CHECK(a.joints[i].tip == b.joints[i].tip);
    }
}

} // namespace

TEST_CASE("JSON that is nested deeply or has countless keys is refused at once", "[io][template][slow]") {
    const auto error = [](const std::string& json) -> std::string {
        try {
            static_cast<void>(io::parse_template(json));
        } catch (const Error& failure) {
            return failure.what();
        }
        return "no error";
    };
    CHECK_THAT(error(std::string(1000000, '[')), Catch::Matchers::Contains("nested"));
    std::string keys = "{";
    for (int i = 0; i < 300000; ++i) keys += '"' + std::to_string(i) + "\":0,";
    CHECK_THAT(error(keys + "\"a\":0}"), Catch::Matchers::Contains("keys"));
    std::string objects = "["; // each object has its own keys
    for (int i = 0; i < 20000; ++i) objects += R"({"a": 0},)";
    CHECK_THAT(error(objects + "{}]"), Catch::Matchers::Contains("object"));
}

TEST_CASE("the built-in templates are those in the data folder, byte for byte") {
    const std::vector<std::string> names = builtin_template_names();
    CHECK(names == std::vector<std::string>{"human21", "pinocchio18", "quadruped"});
    for (const std::string& name : names) {
        INFO(name);
        const Path file = data_folder / "templates" / (name + ".json");
        CHECK(matches_schema(load_json(file)));
        CHECK(template_to_json(builtin_template(name)) == read_file(file));
        check_same(read_template(file), builtin_template(name));
    }
}

TEST_CASE("a template survives being written and read") {
    SkeletonTemplate odd = builtin_template("pinocchio18");
    odd.name = "a \"quoted\" name";
    odd.joints[0].position = {0.1 + 0.2, 1.0 / 3, -1e-20};
    const std::string text = template_to_json(odd);
    CHECK(matches_schema(json::parse(text)));
    check_same(parse_template(text), odd);

    odd.joints.pop_back();
    CHECK_THROWS_AS(template_to_json(odd), Error); // it could not be read back
}

TEST_CASE("version 1, with y forward and z up, says the same as version 2") {
    json old = human21();
    old["version"] = 1;
    for (json& j : old["joints"]) {
        std::swap(j["position"][1], j["position"][2]);
        if (j.contains("tip")) std::swap(j["tip"][1], j["tip"][2]);
    }
    CHECK(matches_schema(old));
    check_same(parse_template(old.dump()), builtin_template("human21"));

    old["version"] = 2; // a body that lies on its back
    CHECK_FALSE(refusal(old).empty());
}

TEST_CASE("a template needs hips and knees on both sides") {
    for (const std::string part : {"hip", "knee"}) {
        INFO(part);
        json t = human21();
        for (const std::string side : {"left_", "right_"}) {
            const std::string name = side + part, parent = joint(t, name)["parent"];
            for (json& j : t["joints"])
                if (j["parent"] == name) j["parent"] = parent;
            t["joints"].erase(
                std::find_if(t["joints"].begin(), t["joints"].end(), [&](const json& j) { return j["name"] == name; }));
        }
        CHECK_THAT(refusal(t), Catch::Matchers::Contains(part));
    }
}

TEST_CASE("human21 has the joints of the interface") {
    const SkeletonTemplate& t = builtin_template("human21");
    REQUIRE(t.joints.size() == 21);
    CHECK(t.joints[0].name == "crotch");
    const auto parent_of = [&](const std::string& name) -> std::string {
        for (const TemplateJoint& j : t.joints)
            if (j.name == name) return t.joints.at(static_cast<std::size_t>(j.parent)).name;
        return "no such joint";
    };
    CHECK(parent_of("waist") == "crotch");
    CHECK(parent_of("chest") == "waist");
    CHECK(parent_of("neck") == "chest");
    CHECK(parent_of("head") == "neck");
    for (const std::string side : {"left_", "right_"}) {
        CHECK(parent_of(side + "shoulder") == "chest");
        CHECK(parent_of(side + "elbow") == side + "shoulder");
        CHECK(parent_of(side + "wrist") == side + "elbow");
        CHECK(parent_of(side + "hand") == side + "wrist");
        CHECK(parent_of(side + "hip") == "crotch");
        CHECK(parent_of(side + "knee") == side + "hip");
        CHECK(parent_of(side + "ankle") == side + "knee");
        CHECK(parent_of(side + "foot") == side + "ankle");
    }
}

TEST_CASE("pinocchio18 has human21's proportions") {
    const SkeletonTemplate& human = builtin_template("human21");
    const SkeletonTemplate& pinocchio = builtin_template("pinocchio18");
    REQUIRE(pinocchio.joints.size() == 18);
    for (const TemplateJoint& j : pinocchio.joints) {
        const auto same = std::find_if(human.joints.begin(), human.joints.end(), [&](const TemplateJoint& other) {
            return other.role == j.role && other.side == j.side;
        });
        REQUIRE(same != human.joints.end());
        CHECK(j.position == same->position);
        CHECK(j.tip == same->tip);
    }
}

TEST_CASE("a template is looked up by name or by file") {
    CHECK(load_template("pinocchio18").joints.size() == 18);
    CHECK(load_template((data_folder / "templates/human21.json").string()).joints.size() == 21);
    CHECK_THROWS_WITH(load_template("human22"), Catch::Matchers::Contains("neither a built-in template"));
    CHECK_THROWS_WITH(builtin_template("human22"), Catch::Matchers::Contains("human21, pinocchio18"));
    CHECK_THROWS_WITH(load_template(data_folder.string()), Catch::Matchers::Contains("is a folder"));
    CHECK_THROWS_AS(read_template(data_folder / "templates/none.json"), Error);
    try {
        (void)builtin_template("human22");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
    }
}

TEST_CASE("text that is no template is refused") {
    CHECK(refusal(std::string()).find("no valid JSON: parse error at line 1") != std::string::npos);
    CHECK(refusal(std::string("{\"format\": ")).find("no valid JSON") != std::string::npos);
    CHECK(refusal(std::string("[]")) == "the template must be a JSON object");
    CHECK(refusal(std::string("{}")) == "the template has no \"format\"");
    CHECK(refusal(std::string("{\"format\": \"\xff\"}")).find("no valid JSON") != std::string::npos);

    json wrong = human21();
    wrong["format"] = "skelgen-skeleton";
    CHECK(refusal(wrong).find("\"format\" must be") != std::string::npos);
    wrong = human21();
    wrong["version"] = 3;
    CHECK(refusal(wrong).find("\"version\" must be 1 or 2") != std::string::npos);
    CHECK_FALSE(matches_schema(wrong));
    wrong = human21();
    wrong["joints"] = 3;
    CHECK(refusal(wrong).find("must be a list") != std::string::npos);
    wrong = human21();
    wrong["jionts"] = json::array();
    CHECK(refusal(wrong).find("unknown key \"jionts\"") != std::string::npos);
}

TEST_CASE("every half of a template file is refused or read, and nothing else happens") {
    const std::string text = human21().dump();
    for (std::size_t length = 0; length < text.size(); length += 7) CHECK(!refusal(text.substr(0, length)).empty());
    CHECK(refusal(text).empty());
}

TEST_CASE("joints that are written wrongly are refused by name") {
    json t = human21();
    joint(t, "neck").erase("role");
    CHECK(refusal(t) == "joint 'neck' has no \"role\"");
    CHECK_FALSE(matches_schema(t));

    t = human21();
    joint(t, "neck").erase("name");
    CHECK(refusal(t) == "joint number 4 has no \"name\"");

    t = human21();
    joint(t, "neck")["role"] = "fin";
    CHECK(refusal(t).find("joint 'neck' has the unknown role 'fin': use one of pelvis, waist,") == 0);
    CHECK_FALSE(matches_schema(t));
    joint(t, "neck")["role"] = "tail"; // an animal's
    CHECK(refusal(t).find("only a template of the plan quadruped has one") != std::string::npos);

    t = human21();
    joint(t, "left_knee")["side"] = "links";
    CHECK(refusal(t) == "joint 'left_knee' has the unknown side 'links': use one of none, left, right");
    CHECK_FALSE(matches_schema(t));

    for (const json& position : {json(1.0), json({1, 2}), json({1, 2, "3"}), json({1, 2, nullptr})}) {
        t = human21();
        joint(t, "neck")["position"] = position;
        CHECK(refusal(t) == "joint 'neck': \"position\" must be three numbers");
        CHECK_FALSE(matches_schema(t));
    }

    t = human21();
    joint(t, "head")["tip"] = "up";
    CHECK(refusal(t) == "joint 'head': \"tip\" must be three numbers");
    CHECK_FALSE(matches_schema(t));

    t = human21();
    joint(t, "neck")["weight"] = 1;
    CHECK(refusal(t) == "joint 'neck' has an unknown key \"weight\": remove it");
    CHECK_FALSE(matches_schema(t));

    t = human21();
    joint(t, "neck")["position"][2] = 12345.5;
    std::string overflow = t.dump();
    overflow.replace(overflow.find("12345.5"), 7, "1e999");
    CHECK(refusal(overflow).find("number overflow") != std::string::npos);
}

TEST_CASE("parents that form no tree are refused by name") {
    json t = human21();
    joint(t, "neck")["parent"] = "nape";
    CHECK(refusal(t) == "joint 'neck' has the unknown parent 'nape'");

    t = human21();
    joint(t, "neck")["parent"] = "left_hand";
    CHECK(refusal(t) == "joint 'neck' comes before its parent 'left_hand': list parents before children");

    t = human21();
    joint(t, "neck")["parent"] = "head";
    CHECK(refusal(t) == "joint 'neck' is its own ancestor: parents must form a tree");

    t = human21();
    joint(t, "neck")["parent"] = "neck";
    CHECK(refusal(t) == "joint 'neck' is its own ancestor: parents must form a tree");

    t = human21();
    joint(t, "neck")["parent"] = 2;
    CHECK(refusal(t) == "joint 'neck': \"parent\" must be a joint's name, or null for the root");

    t = human21();
    joint(t, "neck")["parent"] = nullptr;
    CHECK(refusal(t) == "joint 'neck' has no parent: only the first joint, the root, may have none");
}
