// The bodies of data/sample/makehuman: of all ages, with fists, spread fingers and mittens, and exact joints.

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <skelgen/extract.hpp>
#include <skelgen/hands/find_hands.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/truth_json.hpp>

#include "catch.hpp"

using namespace skelgen;

namespace {

struct MakeHumanBody {
    io::GroundTruth truth;
    KinematicSkeleton<double> skeleton; ///< with digits
    std::vector<hands::Hand<double>> hands;
};

const MakeHumanBody& body_named(const std::string& name) {
    static std::map<std::string, MakeHumanBody> known;
    if (const auto found = known.find(name); found != known.end()) return found->second;
    const std::string path = std::string(SKELGEN_DATA) + "/sample/makehuman/" + name;
    const auto mesh = io::read_mesh<double>(path + ".off");
    const Extraction<double> found = extract(mesh);
    MakeHumanBody out{io::read_ground_truth(path + ".json"), found.skeleton, {}};
    out.hands = hands::find_hands(mesh, found.body, found.skeleton);
    out.skeleton = hands::with_digits(found.skeleton, out.hands);
    return known.emplace(name, std::move(out)).first->second;
}

double error_of(const MakeHumanBody& body, const std::string& joint, const Vector3<double>& truth) {
    const int j = find_joint(body.skeleton, joint);
    REQUIRE(j >= 0);
    const Joint<double>& found = body.skeleton.joints[static_cast<std::size_t>(j)];
    CHECK(found.is_present);
    return (found.position - truth).norm() / body.truth.scale;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

} // namespace

TEST_CASE("bodies of all ages and weights are found, left on the left") {
    for (const char* name : {"baby", "child", "heavy-woman", "old-man", "fists", "spread-fingers", "mittens"}) {
        const MakeHumanBody& body = body_named(name);
        INFO(name);
        CHECK(body.skeleton.quality.sides_confidence > 0.9);
        REQUIRE(body.truth.joints.size() == 12);
        for (const auto& [joint, place] : body.truth.joints) {
            INFO(joint);
            CHECK(error_of(body, joint, place) < 0.035);
        }
    }
}

TEST_CASE("five digits of each hand are found where they are, of fists and of spread fingers, too") {
    for (const char* name : {"baby", "child", "heavy-woman", "old-man", "fists", "spread-fingers"}) {
        const MakeHumanBody& body = body_named(name);
        INFO(name);
        REQUIRE(body.hands.size() == 2);
        for (const auto& hand : body.hands) CHECK(hand.digits.size() == 5);
        CHECK(hands::fused_digits(body.hands).empty());
        std::vector<double> errors;
        for (const auto& [joint, place] : body.truth.digits) {
            if (joint.find("toe") != std::string::npos) continue;
            INFO(joint);
            errors.push_back(error_of(body, joint, place));
            CHECK(errors.back() < 0.02);
        }
        REQUIRE(errors.size() == 30);
        CHECK(median(errors) < 0.005);
    }
}

TEST_CASE("fingers in a mitten are one that says so, beside the thumb") {
    const MakeHumanBody& body = body_named("mittens");
    REQUIRE(body.hands.size() == 2);
    for (const auto& hand : body.hands) CHECK(hand.digits.size() == 2);
    const auto fused = hands::fused_digits(body.hands);
    REQUIRE(fused.size() == 2);
    for (const auto& [joint, others] : fused) {
        CHECK((joint == "left_index_1" || joint == "right_index_1"));
        CHECK(others == std::vector<std::string>{"middle", "ring", "little"});
    }
}
