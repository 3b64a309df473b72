#include <skelgen/synth/sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include <skelgen/core/error.hpp>

#include "anatomy.hpp"
#include "characters.hpp"
#include "lines.hpp"

namespace skelgen::synth {
namespace {

using J = BodyJoint;
using Plans = std::vector<BodyPlan>;

constexpr int scape_faces = 24998;
constexpr int faust_faces = 13776;

std::string numbered(const std::string& stem, std::size_t i) {
    const std::string digits = std::to_string(i);
    return stem + std::string(3 - std::min<std::size_t>(3, digits.size()), '0') + digits;
}

BodyShape person(double age, double masculinity, double height = 0, double weight = 0, double muscle = 0.3) {
    BodyShape shape;
    shape.age = age, shape.masculinity = masculinity, shape.height = height, shape.weight = weight,
    shape.muscle = muscle;
    return shape;
}

BodyPlan plan(std::string name, const BodyShape& shape, const BodyPose& pose, int faces = faust_faces) {
    BodyPlan p;
    p.name = std::move(name), p.shape = shape, p.pose = pose, p.faces = faces;
    return p;
}

/// Named poses first, then random ones, all as this person can hold them.
std::vector<BodyPose> poses_of(const BodyShape& shape, std::size_t count, std::uint64_t seed) {
    std::vector<BodyPose> poses;
    for (const std::string& name : pose_names())
        if (poses.size() < count) poses.push_back(spread_limbs(shape, named_pose(name)));
    for (std::uint64_t i = 0; poses.size() < count; ++i) poses.push_back(random_free_pose(shape, seed + i));
    return poses;
}

Plans scape(std::uint64_t seed) {
    const BodyShape shape = person(32, 1, 1.80, 80, 0.6);
    Plans plans;
    for (const BodyPose& pose : poses_of(shape, 71, seed))
        plans.push_back(plan(numbered("mesh", plans.size()), shape, pose, scape_faces));
    return plans;
}

Plans faust(std::uint64_t seed) {
    const std::array<BodyShape, 10> people{person(28, 1, 1.75, 70),      person(25, 0, 1.65, 56),
                                           person(45, 1, 1.82, 98),      person(50, 0, 1.60, 74),
                                           person(35, 1, 1.68, 62, 0.8), person(33, 0, 1.74, 66, 0.6),
                                           person(62, 1, 1.72, 84, 0.1), person(70, 0, 1.58, 64, 0.0),
                                           person(22, 1, 1.92, 78),      person(30, 0, 1.54, 47)};
    const std::array<const char*, 6> named{"a", "t", "walk", "one-leg-up", "arms-overhead", "hands-on-hips"};
    Plans plans;
    for (const BodyShape& shape : people) {
        for (const char* name : named)
            plans.push_back(plan(numbered("body", plans.size()), shape, spread_limbs(shape, named_pose(name))));
        for (std::uint64_t i = 0; i < 4; ++i)
            plans.push_back(plan(numbered("body", plans.size()), shape, random_free_pose(shape, seed + plans.size())));
    }
    return plans;
}

Plans proportions(std::uint64_t seed) {
    const auto with = [](BodyShape shape, const std::function<void(BodyShape&)>& change) {
        change(shape);
        return shape;
    };
    const std::vector<std::pair<std::string, BodyShape>> people{
        {"boy-of-5", person(5, 1)},
        {"girl-of-8", person(8, 0)},
        {"boy-of-11", person(11, 1)},
        {"very-heavy-man", person(45, 1, 1.76, 150)},
        {"very-heavy-woman", person(45, 0, 1.62, 125)},
        {"very-thin", person(25, 0, 1.75, 44)},
        {"long-limbs", with(person(30, 1), [](BodyShape& s) { s.arm_length = 1.3, s.leg_length = 1.35; })},
        {"short-limbs", with(person(30, 1, 1.3), [](BodyShape& s) { s.arm_length = 0.75, s.leg_length = 0.7; })},
        {"long-torso", with(person(30, 0), [](BodyShape& s) { s.torso_length = 1.35; })},
        {"large-head", with(person(30, 1, 1.4), [](BodyShape& s) { s.head_size = 1.4; })},
        {"broad-shoulders", with(person(30, 1, 0, 95, 1), [](BodyShape& s) { s.shoulder_width = 1.25; })},
        {"giant", person(30, 1, 2.25, 120)}};
    Plans plans;
    for (const auto& [name, shape] : people) {
        plans.push_back(plan(name + "-a", shape, spread_limbs(shape, named_pose("a"))));
        plans.push_back(plan(name + "-random", shape, random_free_pose(shape, seed + plans.size())));
    }
    return plans;
}

/// Two people for each of the named changes, one in the pose "a" and one in a random pose, man, woman and between in
/// turn. `changed` is what of their plans the change is put into.
template <typename Change>
Plans changed_people(const std::vector<std::pair<std::string, Change>>& changes, Change BodyPlan::*changed,
                     std::uint64_t seed) {
    Plans plans;
    for (const auto& [name, change] : changes)
        for (const bool random : {false, true}) {
            const BodyShape shape = person(30, static_cast<double>(plans.size() % 3) / 2);
            const BodyPose pose =
                random ? random_free_pose(shape, seed + plans.size()) : spread_limbs(shape, named_pose("a"));
            plans.push_back(plan(name + (random ? "-random" : "-a"), shape, pose));
            plans.back().*changed = change;
        }
    return plans;
}

Plans partial(std::uint64_t seed) {
    const std::vector<std::pair<std::string, std::vector<BodyJoint>>> cuts{
        {"no-feet", {J::left_ankle, J::right_ankle}},
        {"no-hands", {J::left_wrist, J::right_wrist}},
        {"no-left-arm", {J::left_shoulder}},
        {"no-right-forearm", {J::right_elbow}},
        {"one-foot", {J::left_ankle}},
        {"no-hands-no-feet", {J::left_wrist, J::right_wrist, J::left_ankle, J::right_ankle}}};
    return changed_people(cuts, &BodyPlan::missing, seed);
}

constexpr double sunk_in = -0.004; ///< metres: parts so deep in each other are one surface

/// The pose with these joints moved towards the body until something sinks in a few millimetres.
BodyPose closed_in(const BodyShape& shape, BodyPose pose, const std::vector<BodyJoint>& joints) {
    for (int step = 0; step < 160 && limb_clearance(shape, pose) > sunk_in; ++step)
        for (const BodyJoint joint : joints) pose.at(joint).side -= 0.5;
    return pose;
}

Plans joined(std::uint64_t) {
    struct Contact {
        const char* name;
        JointAngles shoulder, elbow, hip, knee; ///< on both sides
        std::vector<BodyJoint> closing;
    };
    const std::vector<BodyJoint> arms{J::left_shoulder, J::right_shoulder}, legs{J::left_hip, J::right_hip};
    const std::vector<Contact> contacts{
        {"hands-on-thighs", {4, 30, 0}, {10, -10, 0}, {0, 18, 4}, {}, arms},
        {"one-hand-on-thigh", {4, 30, 0}, {10, -10, 0}, {0, 18, 4}, {}, {J::left_shoulder}},
        {"forearms-on-torso", {-14, 30, -20}, {32, -6, 0}, {0, 8, 4}, {}, arms},
        {"heels-together", {0, 35, 0}, {8, 0, 0}, {26, 48, 48}, {76, 0, 0}, legs},
        {"thighs-together", {0, 35, 0}, {8, 0, 0}, {0, 0, 2}, {}, {}}, // no handle: no gap below the crotch
        {"hands-clasped", {42, 18, -36}, {56, 0, 0}, {0, 8, 4}, {}, arms},
        {"hands-on-waist", {-22, 52, -52}, {96, 0, 0}, {0, 8, 4}, {}, arms}};
    Plans plans;
    for (const Contact& contact : contacts)
        for (const double masculinity : {1.0, 0.0}) {
            const BodyShape shape = person(30, masculinity);
            BodyPose pose;
            for (const auto& [joint, angles] : {std::pair{J::left_shoulder, contact.shoulder},
                                                {J::left_elbow, contact.elbow},
                                                {J::left_hip, contact.hip},
                                                {J::left_knee, contact.knee}})
                pose.at(joint) = pose.at(mirrored_joint(joint)) = angles;
            plans.push_back(plan(contact.name + std::string(masculinity > 0 ? "-man" : "-woman"), shape,
                                 closed_in(shape, pose, contact.closing)));
            plans.back().may_touch = true;
        }
    return plans;
}

Plans scan(std::uint64_t seed) {
    const std::vector<std::pair<std::string, ScanFaults>> faults{
        {"noise", {0.0012, 0, 0, 0, 0, 0.03, 0}}, {"holes", {0, 12, 0, 0, 0, 0.03, 0}},
        {"floating", {0, 0, 6, 0, 0, 0.03, 0}},   {"flipped", {0, 0, 0, 5, 0, 0.03, 0}},
        {"pinched", {0, 0, 0, 0, 8, 0.03, 0}},    {"everything", {0.001, 8, 4, 3, 4, 0.03, 0}}};
    Plans plans = changed_people(faults, &BodyPlan::faults, seed);
    for (BodyPlan& each : plans) each.faults.seed = ++seed;
    return plans;
}

/// The joint on both sides turned by `step` again and again until the smallest gap between parts is `gap`: apart where
/// it was smaller, towards each other where it was larger, as far as the joint goes.
BodyPose with_gap(const BodyShape& shape, BodyPose pose, BodyJoint joint, const JointAngles& step, double gap) {
    const AngleRange limits = joint_limits(joint);
    const auto turn = [&](double sign) {
        JointAngles& angles = pose.at(joint);
        angles.bend = std::clamp(angles.bend + sign * step.bend, limits.low.bend, limits.high.bend);
        angles.side = std::clamp(angles.side + sign * step.side, limits.low.side, limits.high.side);
        angles.turn = std::clamp(angles.turn + sign * step.turn, limits.low.turn, limits.high.turn);
        pose.at(mirrored_joint(joint)) = angles;
    };
    constexpr int most_steps = 160;
    for (int i = 0; i < most_steps && limb_clearance(shape, pose) < gap; ++i) turn(-1);
    for (int i = 0; i < most_steps && limb_clearance(shape, pose) > gap; ++i) turn(1);
    return pose;
}

Plans curled(std::uint64_t) {
    struct Curl {
        const char* name;
        JointAngles crotch{}, waist{}, chest{}, neck{};
        JointAngles shoulder{}, elbow{}, wrist{}, hip{}, knee{}, ankle{}; ///< on both sides
        BodyJoint closing;
        JointAngles step; ///< of the closing joint
    };
    const std::vector<Curl> curls{{.name = "squat",
                                   .crotch = {25, 0, 0},
                                   .waist = {22, 0, 0},
                                   .chest = {10, 0, 0},
                                   .neck = {-20, 0, 0},
                                   .shoulder = {80, 14, 0},
                                   .elbow = {12, 0, 0},
                                   .hip = {112, 16, 10},
                                   .knee = {146, 0, 0},
                                   .ankle = {24, 0, 0},
                                   .closing = J::left_shoulder,
                                   .step = {0, -0.5, 0}},
                                  {.name = "hands-on-knees",
                                   .waist = {10, 0, 0},
                                   .chest = {4, 0, 0},
                                   .shoulder = {48, 12, -8},
                                   .elbow = {30, 0, 0},
                                   .wrist = {0, 0, -70},
                                   .hip = {86, 12, 4},
                                   .knee = {88, 0, 0},
                                   .closing = J::left_shoulder,
                                   .step = {-0.5, 0, 0}},
                                  {.name = "hands-in-lap",
                                   .waist = {6, 0, 0},
                                   .chest = {4, 0, 0},
                                   .neck = {10, 0, 0},
                                   .shoulder = {28, 10, -34},
                                   .elbow = {66, 0, 0},
                                   .wrist = {0, 0, -60},
                                   .hip = {86, 10, 4},
                                   .knee = {88, 0, 0},
                                   .closing = J::left_elbow,
                                   .step = {-0.5, 0, 0}},
                                  {.name = "hands-behind-back",
                                   .shoulder = {-34, 22, -84},
                                   .elbow = {70, 0, 0},
                                   .hip = {0, 8, 4},
                                   .knee = {0, -3, 0},
                                   .closing = J::left_elbow,
                                   .step = {0.5, 0, 0}},
                                  {.name = "kneeling-on-heels",
                                   .crotch = {10, 0, 0},
                                   .waist = {8, 0, 0},
                                   .shoulder = {22, 14, 0},
                                   .elbow = {24, 0, 0},
                                   .wrist = {0, 0, -60},
                                   .hip = {78, 8, 0},
                                   .knee = {146, 0, 0},
                                   .ankle = {-50, 0, 0},
                                   .closing = J::left_shoulder,
                                   .step = {-0.5, 0, 0}},
                                  {.name = "knees-to-chest",
                                   .crotch = {14, 0, 0},
                                   .waist = {34, 0, 0},
                                   .chest = {16, 0, 0},
                                   .neck = {8, 0, 0},
                                   .shoulder = {58, 22, -6},
                                   .elbow = {34, 0, 0},
                                   .wrist = {0, 0, -40},
                                   .hip = {122, 8, 2},
                                   .knee = {132, 0, 0},
                                   .ankle = {-6, 0, 0},
                                   .closing = J::left_shoulder,
                                   .step = {0, -0.5, 0}},
                                  {.name = "foetal",
                                   .waist = {46, 0, 0},
                                   .chest = {22, 0, 0},
                                   .neck = {26, 0, 0},
                                   .shoulder = {52, 20, -18},
                                   .elbow = {120, 0, 0},
                                   .wrist = {0, 0, -30},
                                   .hip = {108, 14, 2},
                                   .knee = {112, 0, 0},
                                   .ankle = {-20, 0, 0},
                                   .closing = J::left_shoulder,
                                   .step = {0, -0.5, 0}},
                                  {.name = "hands-on-shoulders",
                                   .shoulder = {40, 30, -40},
                                   .elbow = {118, 0, 0},
                                   .hip = {0, 8, 4},
                                   .knee = {0, -3, 0},
                                   .closing = J::left_elbow,
                                   .step = {0.5, 0, 0}}};
    constexpr double just_apart = 0.004;
    Plans plans;
    for (const Curl& curl : curls) {
        BodyPose pose;
        pose.at(J::crotch) = curl.crotch, pose.at(J::waist) = curl.waist;
        pose.at(J::chest) = curl.chest, pose.at(J::neck) = curl.neck;
        for (const auto& [joint, angles] : {std::pair{J::left_shoulder, curl.shoulder},
                                            {J::left_elbow, curl.elbow},
                                            {J::left_wrist, curl.wrist},
                                            {J::left_hip, curl.hip},
                                            {J::left_knee, curl.knee},
                                            {J::left_ankle, curl.ankle}})
            pose.at(joint) = pose.at(mirrored_joint(joint)) = angles;
        for (const bool joins : {false, true}) {
            const BodyShape shape = person(30, joins ? 1 : 0);
            const double gap = joins ? sunk_in : just_apart;
            BodyPose closed = with_gap(shape, pose, curl.closing, curl.step, gap);
            // Forearms that pass beside the legs come to them from the sides.
            if (limb_clearance(shape, closed) > gap)
                closed = with_gap(shape, pose, J::left_shoulder, {0, -0.5, 0}, gap);
            plans.push_back(plan(std::string(curl.name) + (joins ? "-joined" : "-touching"), shape, closed));
            plans.back().may_touch = true;
        }
    }
    return plans;
}

/// Arms and legs further apart than a naked body needs.
BodyPose dressed_pose(const BodyShape& shape, const char* name) {
    BodyPose pose = spread_limbs(shape, named_pose(name));
    for (const J joint : {J::left_shoulder, J::right_shoulder}) pose.at(joint).side += 12;
    for (const J joint : {J::left_hip, J::right_hip}) pose.at(joint).side += 4;
    return pose;
}

Plans dressed(std::uint64_t) {
    using G = Garment;
    const std::vector<std::pair<std::string, std::vector<Garment>>> outfits{
        {"trousers-and-boots", {G::trousers, G::boots}},
        {"skirt", {G::skirt, G::boots}},
        {"coat", {G::coat, G::trousers, G::boots}},
        {"hat", {G::hat}},
        {"long-hair", {G::long_hair}},
        {"rucksack", {G::rucksack, G::trousers}},
        {"winter", {G::trousers, G::boots, G::coat, G::hat, G::rucksack}}};
    Plans plans;
    for (const auto& [name, clothes] : outfits)
        for (const char* pose : {"a", "walk"}) {
            const BodyShape shape = person(30, name == "skirt" || name == "long-hair" ? 0 : 1);
            plans.push_back(plan(name + "-" + pose, shape, dressed_pose(shape, pose)));
            plans.back().clothes = clothes;
        }
    return plans;
}

Plans cartoon(std::uint64_t seed) {
    using G = Garment;
    struct Figure {
        const char* name;
        BodyShape shape;
        std::vector<Garment> wears;
    };
    /// Head, torso, legs, arms, hands, feet and girth of the limbs, relative to a grown-up's.
    const auto figure = [](double head, double torso, double leg, double arm, double hand, double foot, double girth) {
        BodyShape shape = person(30, 0.5, 1.2);
        shape.head_size = head, shape.torso_length = torso, shape.leg_length = leg, shape.arm_length = arm;
        shape.hand_size = hand, shape.foot_size = foot, shape.limb_girth = girth;
        return shape;
    };
    const auto broad = [](BodyShape shape, double shoulders, double hips, double weight) {
        shape.shoulder_width = shoulders, shape.hip_width = hips, shape.weight = weight;
        return shape;
    };
    const std::vector<Figure> figures{
        {"third-is-head", figure(2.4, 0.85, 0.5, 0.75, 1.1, 1.0, 1.0), {}},
        {"small-child", figure(1.8, 0.9, 0.6, 0.7, 1, 0.9, 1.1), {}},
        {"legs-of-a-quarter", broad(figure(1.8, 1, 0.42, 0.9, 1.3, 1.2, 1.2), 1, 1.3, 0), {}},
        {"dwarf", broad(figure(1.5, 0.9, 0.5, 0.7, 1.2, 1.2, 1.15), 1.2, 1.4, 40), {G::boots}},
        {"ape", broad(figure(1.1, 1, 0.55, 1.4, 1.4, 1.3, 1.2), 1.3, 1.1, 0), {}},
        {"paws", figure(1.6, 0.9, 0.7, 0.9, 1.6, 1.4, 1.1), {G::mittens}},
        {"boots", figure(1.7, 0.9, 0.7, 0.9, 1.2, 1.3, 0.8), {G::boots}},
        {"horns", figure(1.5, 0.9, 0.7, 0.9, 1.3, 1.2, 1), {G::horns, G::mittens}},
        {"tail", figure(1.5, 0.9, 0.7, 0.9, 1.3, 1.2, 1), {G::boots, G::tail}},
        {"doll", figure(2, 0.8, 0.9, 0.9, 0.9, 0.8, 0.7), {G::long_hair}},
        {"stick", figure(1.8, 0.8, 1.2, 1.3, 1.4, 1.3, 0.6), {}},
        {"barrel", broad(figure(1, 1.4, 0.5, 0.8, 1.2, 1.2, 1.1), 1.1, 1.3, 46), {}}};
    Plans plans;
    for (const auto& [name, shape, wears] : figures) {
        const bool naked = wears.empty();
        plans.push_back(plan(std::string(name) + "-a", shape,
                             naked ? spread_limbs(shape, named_pose("a")) : dressed_pose(shape, "a")));
        plans.back().clothes = wears;
        plans.push_back(naked ? plan(std::string(name) + "-random", shape, random_free_pose(shape, seed + plans.size()))
                              : plan(std::string(name) + "-walk", shape, dressed_pose(shape, "walk")));
        plans.back().clothes = wears;
    }
    return plans;
}

Plans armed(std::uint64_t) {
    using G = Garment;
    struct Figure {
        const char* name;
        BodyShape shape;
        std::vector<Garment> wears;
    };
    BodyShape wizard = person(60, 1, 1.2), dwarf = wizard, brute = wizard, stout = wizard;
    wizard.head_size = 1.5, wizard.arm_length = 0.9, wizard.leg_length = 0.7, wizard.hand_size = 1.3;
    dwarf.head_size = 1.5, dwarf.arm_length = 0.7, dwarf.leg_length = 0.5, dwarf.hand_size = 1.2;
    dwarf.shoulder_width = 1.2, dwarf.hip_width = 1.4, dwarf.weight = 40;
    brute.head_size = 1.2, brute.arm_length = 1.3, brute.leg_length = 0.55, brute.hand_size = 1.4;
    brute.shoulder_width = 1.3, brute.limb_girth = 1.2, brute.foot_size = 1.3;
    stout.head_size = 1.3, stout.arm_length = 0.8, stout.leg_length = 0.45, stout.limb_girth = 1.2;
    stout.shoulder_width = 1.2, stout.hip_width = 1.4, stout.weight = 50;
    const std::vector<Figure> figures{{"shepherd", person(50, 1), {G::staff}},
                                      {"fencer", person(25, 0), {G::sword}},
                                      {"woodman", person(40, 1, 0, 95, 0.8), {G::trousers, G::axe}},
                                      {"wizard", wizard, {G::hat, G::staff}},
                                      {"dwarf", dwarf, {G::boots, G::axe}},
                                      {"brute", brute, {G::horns, G::sword}},
                                      {"stout", stout, {G::boots}}};
    Plans plans;
    for (const auto& [name, shape, wears] : figures)
        for (const bool raised : {false, true}) { // the forearm, so that what it holds stands upright
            BodyPose pose = dressed_pose(shape, "a");
            if (raised && wears.back() == G::boots) continue; // holds nothing
            if (raised) pose.at(J::right_shoulder) = {20, 30, 0}, pose.at(J::right_elbow) = {70, 0, 0};
            plans.push_back(plan(std::string(name) + (raised ? "-raised" : "-a"), shape, pose));
            plans.back().clothes = wears;
        }
    return plans;
}

Plans pieces(std::uint64_t) {
    using G = Garment;
    using L = LimbPieces;
    const std::vector<std::pair<std::string, BodyPieces>> makes{
        {"seams", {L::whole, true, false, false}},          {"face", {L::whole, false, true, false}},
        {"closed-limbs", {L::closed, false, false, false}}, {"open-limbs", {L::open, false, false, false}},
        {"clothes", {L::whole, false, false, true}},        {"doll", {L::closed, true, true, false}},
        {"character", {L::open, true, true, true}}};
    Plans plans;
    for (const auto& [name, make] : makes)
        for (const char* pose : {"a", "walk"}) {
            const BodyShape shape = person(30, static_cast<double>(plans.size() % 3) / 2);
            plans.push_back(plan(name + "-" + pose, shape, dressed_pose(shape, pose)));
            plans.back().pieces = make;
            if (make.clothes) plans.back().clothes = {G::trousers, G::boots, G::hat};
        }
    return plans;
}

Plans mouths(std::uint64_t seed) {
    const std::vector<std::pair<const char*, BodyShape>> people{
        {"man", person(30, 1)}, {"woman", person(25, 0)}, {"elder", person(70, 0.3)}};
    Plans plans;
    for (const auto& [who, shape] : people)
        for (const auto& [name, open] : {std::pair{"speaking", 0.5}, {"singing", 0.8}, {"shouting", 1.0}}) {
            const BodyPose pose =
                plans.size() % 3 == 0 ? named_pose("a") : random_free_pose(shape, seed + plans.size());
            plans.push_back(plan(std::string(who) + "-" + name, shape, pose));
            plans.back().shape.mouth = open;
        }
    return plans;
}

/// The smallest gap between a usual hand's thumb and its fingers, metres: a little too large at most.
double thumb_gap(const HandShape& shape) {
    constexpr int samples = 6; // a bone
    const Hand usual = hand(proportions_of({}), {}, shape);
    const auto on_bones = [&](const HandDigit& digit) {
        std::vector<Vec3> out;
        for (std::size_t k = 1; k < digit.places.size(); ++k)
            for (int i = 0; i <= samples; ++i)
                out.emplace_back(digit.places[k - 1] + (digit.places[k] - digit.places[k - 1]) * i / samples);
        return out;
    };
    const std::vector<Vec3> thumb = on_bones(usual.digits[0]);
    double least = 1;
    for (std::size_t d = 1; d < usual.digits.size(); ++d)
        for (const Vec3& p : on_bones(usual.digits[d]))
            for (std::size_t i = samples + 1; i < thumb.size(); ++i) least = std::min(least, (p - thumb[i]).norm());
    return least - usual.digits[0].end_radius / 0.7 - usual.digits[1].end_radius / 0.7;
}

/// The hands of one body, drawn at random.
class DrawnHands {
public:
    explicit DrawnHands(std::uint64_t seed) : random_(seed) {}

    [[nodiscard]] double between(double low, double high) { return std::lerp(low, high, uniform(random_)); }
    [[nodiscard]] bool is_one_in(double count) { return uniform(random_) * count < 1; }
    [[nodiscard]] int one_of(int low, int high) {
        return low + static_cast<int>(uniform(random_) * static_cast<double>(high - low + 1));
    }

    void draw(BodyPlan& body, std::size_t which) {
        HandShape& hand = body.hands[which];
        const double kind = uniform(random_);
        hand.digits = kind < 0.3 || kind > 0.7 ? 5 : kind < 0.5 ? one_of(2, 4) : 5;
        hold(hand, between(-5, 50), between(0, 8));
        if (kind >= 0.5 && kind < 0.7)
            join(hand);
        else if (kind >= 0.7 && kind < 0.8) {
            hold(hand, between(0, 25), between(6, 10));
            hand.glove = between(0.0005, 0.002);
        } else if (kind >= 0.8 && kind < 0.9) {
            hold(hand, between(44, 56), 2);
            hand.holds = static_cast<HeldThing>(one_of(1, 3));
        } else if (kind >= 0.9 && kind < 0.95) {
            make_fist(hand);
            body.may_touch = true;
        } else if (kind >= 0.95)
            body.missing.push_back(which == 0 ? J::left_wrist : J::right_wrist);
    }

private:
    void hold(HandShape& hand, double curl, double spread) {
        for (DigitShape& digit : hand.digit) {
            digit.curl = std::max(-10.0, curl + between(-6, 6));
            digit.spread = spread + between(-1, 1);
        }
        constexpr double least_gap_of_thumb = 0.004;
        constexpr int attempts = 20;
        for (int i = 0; i < attempts; ++i) {
            hand.digit[0].curl = between(0, 20);
            hand.digit[0].spread = between(0, 14);
            if (thumb_gap(hand) > least_gap_of_thumb) return;
        }
        hand.digit[0] = {0, 10, false};
    }

    /// All fingers, or two of them.
    void join(HandShape& hand) {
        const bool all = is_one_in(2);
        const auto last = static_cast<std::size_t>(hand.digits - 2);
        const auto only = static_cast<std::size_t>(one_of(1, static_cast<int>(last)));
        for (std::size_t i = 1; i <= last; ++i) hand.digit[i].joined = all || i == only;
    }

    void make_fist(HandShape& hand) {
        for (DigitShape& digit : hand.digit) digit = {between(86, 90), 0, false};
        hand.digit[0] = {between(20, 40), 0, false};
    }

    std::mt19937_64 random_;
};

/// The body's arms are closed in until hands are almost at its thighs.
void put_hands_to_thighs(BodyPlan& body, double gap) {
    for (const J joint : {J::left_shoulder, J::right_shoulder}) body.pose.at(joint) = {4, 40, 0};
    for (const J joint : {J::left_elbow, J::right_elbow}) body.pose.at(joint) = {10, -10, 0};
    for (const J joint : {J::left_hip, J::right_hip}) body.pose.at(joint) = {0, 16, 4};
    constexpr int most_steps = 120;
    for (const J joint : {J::left_shoulder, J::right_shoulder}) {
        double& side = body.pose.at(joint).side;
        for (int step = 0; step < most_steps && limb_clearance(body) > gap; ++step) side -= 0.5;
        side += 0.5;
    }
}

/// One in three bodies in a random pose, one in a named one, one with its hands at the thighs.
Plans hands(std::uint64_t seed) {
    constexpr int bodies = 24, faces = 20000;
    constexpr double room = 0.008, at_thigh = 0.012; // metres
    const std::array<const char*, 4> named{"a", "t", "walk", "arms-overhead"};
    Plans plans;
    for (std::uint64_t i = 0; i < bodies; ++i) {
        DrawnHands drawn(seed * 1000 + i);
        const double age = drawn.between(12, 75), masculinity = drawn.between(0, 1);
        BodyPlan body = plan(numbered("hands", plans.size()), person(age, masculinity), {}, faces);
        for (const std::size_t which : {0U, 1U}) drawn.draw(body, which);
        const auto hold = [&](const BodyPose& pose) {
            body.pose = pose;
            for (const J joint : {J::left_hand, J::right_hand}) body.pose.at(joint) = {}; // the hands' own
            return limb_clearance(body) > room;
        };
        if (i % 3 == 0)
            for (std::uint64_t attempt = 0; !hold(random_free_pose(body.shape, seed * 1000 + 24 * attempt + i));
                 ++attempt) {
            }
        else
            (void)hold(spread_limbs(body.shape, named_pose(named[i / 3 % named.size()])));
        if (i % 3 == 2) put_hands_to_thighs(body, at_thigh);
        plans.push_back(body);
    }
    return plans;
}

Plans characters(std::uint64_t seed) {
    constexpr std::uint64_t bodies = 100;
    Plans plans;
    for (std::uint64_t i = 0; i < bodies; ++i) plans.push_back(character(seed, i));
    return plans;
}

struct NamedSet {
    const char* name;
    Plans (*plans)(std::uint64_t seed);
};

constexpr std::array<NamedSet, 14> sets{{{"scape", scape},
                                         {"faust", faust},
                                         {"proportions", proportions},
                                         {"partial", partial},
                                         {"joined", joined},
                                         {"scan", scan},
                                         {"dressed", dressed},
                                         {"pieces", pieces},
                                         {"cartoon", cartoon},
                                         {"curled", curled},
                                         {"mouths", mouths},
                                         {"armed", armed},
                                         {"hands", hands},
                                         {"characters", characters}}};

} // namespace

std::vector<std::string> set_names() {
    std::vector<std::string> names;
    for (const NamedSet& set : sets) names.emplace_back(set.name);
    return names;
}

std::vector<BodyPlan> body_set(std::string_view name, std::uint64_t seed) {
    for (const NamedSet& set : sets)
        if (name == set.name) return set.plans(seed);
    std::string what = "there is no set " + std::string(name) + ": give one of";
    for (const std::string& known : set_names()) what += " " + known;
    throw Error(ErrorCode::usage, what);
}

} // namespace skelgen::synth
