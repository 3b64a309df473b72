#include <skelgen/synth/pose.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <sstream>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>

namespace skelgen::synth {
namespace {

using J = BodyJoint;
using Json = nlohmann::json;

AngleRange range(double bend_low, double bend_high, double side_low, double side_high, double turn_low,
                 double turn_high) {
    return {{bend_low, side_low, turn_low}, {bend_high, side_high, turn_high}};
}

struct Setting {
    BodyJoint joint; ///< a left joint or one in the middle
    JointAngles angles;
};

void set(BodyPose& pose, std::initializer_list<Setting> settings) {
    for (const Setting& s : settings) pose.at(s.joint) = s.angles;
}

/// The same on both sides.
void set_both(BodyPose& pose, std::initializer_list<Setting> settings) {
    set(pose, settings);
    for (const Setting& s : settings) pose.at(mirrored_joint(s.joint)) = s.angles;
}

BodyPose arms_at(double side) {
    BodyPose pose;
    set_both(pose, {{J::left_shoulder, {0, side, 0}},
                    {J::left_elbow, {8, 0, 0}},
                    {J::left_hip, {0, 8, 6}},
                    {J::left_knee, {0, -3, 0}}});
    return pose;
}

BodyPose walk() {
    BodyPose pose;
    set(pose, {{J::waist, {3, 0, -6}},
               {J::chest, {0, 0, -4}},
               {J::neck, {0, 0, 6}},
               {J::left_hip, {28, 5, 4}},
               {J::left_knee, {8, -4, 0}},
               {J::left_ankle, {4, 0, 0}},
               {J::right_hip, {-16, 5, 4}},
               {J::right_knee, {28, -4, 0}},
               {J::right_ankle, {-8, 0, 0}},
               {J::right_foot, {22, 0, 0}},
               {J::left_shoulder, {-24, 12, 0}},
               {J::left_elbow, {14, 0, 0}},
               {J::right_shoulder, {26, 10, 0}},
               {J::right_elbow, {24, 0, 0}}});
    return pose;
}

BodyPose run() {
    BodyPose pose;
    set(pose, {{J::crotch, {8, 0, 0}},
               {J::waist, {8, 0, -10}},
               {J::chest, {0, 0, -6}},
               {J::neck, {-8, 0, 8}},
               {J::left_hip, {62, 3, 3}},
               {J::left_knee, {78, 0, 0}},
               {J::left_ankle, {6, 0, 0}},
               {J::right_hip, {-14, 2, 3}},
               {J::right_knee, {52, 0, 0}},
               {J::right_ankle, {-26, 0, 0}},
               {J::right_foot, {18, 0, 0}},
               {J::left_shoulder, {-42, 18, 0}},
               {J::left_elbow, {86, 0, 0}},
               {J::left_hand, {50, 0, 0}},
               {J::right_shoulder, {42, 14, 0}},
               {J::right_elbow, {88, 0, 0}},
               {J::right_hand, {50, 0, 0}}});
    return pose;
}

BodyPose sit() {
    BodyPose pose;
    set_both(pose, {{J::left_hip, {84, 12, 4}},
                    {J::left_knee, {86, 0, 0}},
                    {J::left_shoulder, {32, 16, 0}},
                    {J::left_elbow, {38, 0, 0}},
                    {J::left_wrist, {0, 0, -60}}});
    set(pose, {{J::waist, {8, 0, 0}}});
    return pose;
}

BodyPose kneel() {
    BodyPose pose;
    set_both(pose, {{J::left_hip, {12, 8, 0}},
                    {J::left_knee, {98, 0, 0}},
                    {J::left_ankle, {-38, 0, 0}},
                    {J::left_shoulder, {8, 16, 0}},
                    {J::left_elbow, {14, 0, 0}}});
    return pose;
}

BodyPose crouch() {
    BodyPose pose;
    set_both(pose, {{J::left_hip, {92, 22, 12}},
                    {J::left_knee, {112, 0, 0}},
                    {J::left_ankle, {22, 0, 0}},
                    {J::left_shoulder, {72, 22, 0}},
                    {J::left_elbow, {30, 0, 0}}});
    set(pose, {{J::crotch, {22, 0, 0}}, {J::waist, {18, 0, 0}}, {J::chest, {10, 0, 0}}, {J::neck, {-20, 0, 0}}});
    return pose;
}

BodyPose hands_on_hips() {
    BodyPose pose = arms_at(0);
    set_both(pose, {{J::left_shoulder, {-22, 52, -52}}, {J::left_elbow, {96, 0, 0}}, {J::left_wrist, {20, 0, 30}}});
    return pose;
}

BodyPose arms_crossed() {
    BodyPose pose = arms_at(0);
    set(pose, {{J::left_shoulder, {52, 10, -58}},
               {J::left_elbow, {84, 0, 0}},
               {J::left_wrist, {0, 0, -50}},
               {J::right_shoulder, {84, 10, -62}},
               {J::right_elbow, {78, 0, 0}},
               {J::right_wrist, {0, 0, -50}}});
    return pose;
}

BodyPose one_leg_up() {
    BodyPose pose = arms_at(62);
    set(pose, {{J::left_hip, {84, 8, 0}},
               {J::left_knee, {88, 0, 0}},
               {J::left_ankle, {-10, 0, 0}},
               {J::right_hip, {0, 3, 4}}});
    return pose;
}

BodyPose handstand() {
    BodyPose pose;
    set_both(pose, {{J::left_shoulder, {160, 30, 0}},
                    {J::left_wrist, {-55, 0, -60}},
                    {J::left_hip, {0, 7, 0}},
                    {J::left_ankle, {-32, 0, 0}}});
    set(pose, {{J::crotch, {180, 0, 0}}, {J::neck, {-14, 0, 0}}});
    return pose;
}

BodyPose lying() {
    BodyPose pose = arms_at(28);
    pose.at(J::crotch) = {-90, 0, 0};
    set_both(pose, {{J::left_ankle, {-24, 0, 0}}, {J::left_hip, {0, 9, 16}}});
    return pose;
}

const std::map<std::string, BodyPose, std::less<>>& library() {
    static const std::map<std::string, BodyPose, std::less<>> poses{{"a", arms_at(42)},
                                                                    {"t", arms_at(88)},
                                                                    {"arms-down", arms_at(15)},
                                                                    {"arms-overhead", arms_at(164)},
                                                                    {"stand", BodyPose{}},
                                                                    {"walk", walk()},
                                                                    {"run", run()},
                                                                    {"sit", sit()},
                                                                    {"kneel", kneel()},
                                                                    {"crouch", crouch()},
                                                                    {"hands-on-hips", hands_on_hips()},
                                                                    {"arms-crossed", arms_crossed()},
                                                                    {"one-leg-up", one_leg_up()},
                                                                    {"handstand", handstand()},
                                                                    {"lying", lying()}};
    return poses;
}

void check_angle(std::string_view joint, const char* angle, double value, double low, double high) {
    if (value >= low && value <= high) return;
    std::ostringstream what;
    what << joint << ": " << angle << ' ' << value << " is more than a human joint does: give " << low << " to " << high
         << " degrees";
    throw Error(ErrorCode::usage, what.str());
}

/// A uniform number in [0, 1) from the top bits of the generator: the same with every standard library.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Between the limits, more often near the middle of what people do than at the limits.
double random_angle(std::mt19937_64& random, double low, double high) {
    const double u = (uniform(random) + uniform(random)) - 1; // a triangle over -1 to 1
    return u < 0 ? -u * 0.8 * low : u * 0.8 * high;
}

double number(const Json& value, const std::string& joint) {
    if (!value.is_number())
        throw Error(ErrorCode::bad_input, joint + ": angles must be numbers: [bend, side, turn] in degrees");
    return value.get<double>();
}

} // namespace

AngleRange joint_limits(BodyJoint joint) {
    switch (joint) {
    case J::crotch:
        return range(-180, 180, -180, 180, -180, 180);
    case J::waist:
        return range(-25, 60, -25, 25, -30, 30);
    case J::chest:
        return range(-15, 30, -15, 15, -25, 25);
    case J::neck:
        return range(-30, 35, -25, 25, -45, 45);
    case J::head:
        return range(-20, 20, -15, 15, -30, 30);
    case J::left_shoulder:
    case J::right_shoulder:
        return range(-60, 180, -45, 180, -90, 90);
    case J::left_elbow:
    case J::right_elbow:
        return range(0, 150, -10, 15, 0, 0);
    case J::left_wrist:
    case J::right_wrist:
        return range(-70, 80, -35, 25, -90, 90);
    case J::left_hand:
    case J::right_hand:
        return range(-15, 90, -5, 10, 0, 0);
    case J::left_hip:
    case J::right_hip:
        return range(-30, 125, -30, 60, -45, 50);
    case J::left_knee:
    case J::right_knee:
        return range(0, 155, -5, 5, -10, 10);
    case J::left_ankle:
    case J::right_ankle:
        return range(-55, 30, -25, 20, -15, 15);
    case J::left_foot:
    case J::right_foot:
        return range(-30, 60, 0, 0, 0, 0);
    }
    return {};
}

void check_pose(const BodyPose& pose) {
    for (int j = 0; j < body_joint_count; ++j) {
        const auto joint = static_cast<BodyJoint>(j);
        const AngleRange limits = joint_limits(joint);
        const JointAngles& a = pose.at(joint);
        check_angle(joint_name(joint), "bend", a.bend, limits.low.bend, limits.high.bend);
        check_angle(joint_name(joint), "side", a.side, limits.low.side, limits.high.side);
        check_angle(joint_name(joint), "turn", a.turn, limits.low.turn, limits.high.turn);
    }
}

BodyPose mirrored(const BodyPose& pose) {
    BodyPose result;
    for (int j = 0; j < body_joint_count; ++j) {
        const auto joint = static_cast<BodyJoint>(j);
        JointAngles& angles = result.at(mirrored_joint(joint)) = pose.at(joint);
        if (mirrored_joint(joint) == joint) angles.side = -angles.side, angles.turn = -angles.turn;
    }
    return result;
}

std::vector<std::string> pose_names() {
    std::vector<std::string> names;
    for (const auto& [name, pose] : library()) names.push_back(name);
    return names;
}

BodyPose named_pose(std::string_view name) {
    const auto found = library().find(name);
    if (found != library().end()) return found->second;
    std::string what = "there is no pose " + std::string(name) + ": give one of";
    for (const std::string& known : pose_names()) what += " " + known;
    throw Error(ErrorCode::usage, what);
}

BodyPose random_pose(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    BodyPose pose;
    for (int j = 1; j < body_joint_count; ++j) {
        const auto joint = static_cast<BodyJoint>(j);
        const AngleRange limits = joint_limits(joint);
        JointAngles& a = pose.at(joint);
        a.bend = random_angle(random, limits.low.bend, limits.high.bend);
        a.side = random_angle(random, limits.low.side, limits.high.side);
        a.turn = random_angle(random, limits.low.turn, limits.high.turn);
    }
    return pose;
}

BodyPose parse_pose(std::string_view text) {
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object())
        throw Error(ErrorCode::bad_input, R"(a pose is a JSON object like {"pose": "a", "left_elbow": [90, 0, 0]})");
    BodyPose pose;
    if (json.contains("pose")) {
        if (!json["pose"].is_string()) throw Error(ErrorCode::bad_input, "\"pose\" must be the name of a pose");
        pose = named_pose(json["pose"].get<std::string>());
    }
    for (const auto& [key, value] : json.items()) {
        if (key == "pose") continue;
        int j = 0;
        while (j < body_joint_count && joint_name(static_cast<BodyJoint>(j)) != key) ++j;
        if (j == body_joint_count)
            throw Error(ErrorCode::bad_input, "there is no joint " + key + " in a pose: use the names of human21");
        if (!value.is_array() || value.size() != 3)
            throw Error(ErrorCode::bad_input, key + ": give three angles, [bend, side, turn] in degrees");
        pose.angles[static_cast<std::size_t>(j)] = {number(value[0], key), number(value[1], key),
                                                    number(value[2], key)};
    }
    check_pose(pose);
    return pose;
}

} // namespace skelgen::synth
