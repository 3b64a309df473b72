#include "characters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>

#include "body_surface.hpp"
#include "lines.hpp"

namespace skelgen::synth {
namespace {

using G = Garment;
using J = BodyJoint;

/// Numbers from one generator, the same on every machine.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : random_(seed) {}

    [[nodiscard]] double between(double low, double high) { return std::lerp(low, high, uniform(random_)); }
    [[nodiscard]] bool is_one_in(double count) { return uniform(random_) * count < 1; }
    [[nodiscard]] std::uint64_t seed() { return random_(); }

    /// A factor, as often below as above the middle of its logarithms.
    [[nodiscard]] double factor(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }

    template <typename T, std::size_t n>
    [[nodiscard]] T one_of(const std::array<T, n>& choices) {
        return choices[static_cast<std::size_t>(uniform(random_) * static_cast<double>(n))];
    }

private:
    std::mt19937_64 random_;
};

/// A person, or a figure of any proportions.
BodyShape drawn_shape(Draw& draw) {
    BodyShape shape;
    shape.age = draw.is_one_in(5) ? draw.between(5, 14) : draw.between(15, 75);
    shape.masculinity = draw.between(0, 1), shape.muscle = draw.between(0, 1);
    if (draw.is_one_in(3)) shape.height = draw.between(1.0, 2.1);
    if (draw.is_one_in(6)) shape.mouth = draw.between(0.5, 1);
    const bool is_person = draw.is_one_in(3);
    const auto factor = [&](double low, double high) {
        return is_person ? draw.factor(0.9, 1.1) : draw.factor(low, high);
    };
    shape.head_size = factor(0.8, 3), shape.torso_length = factor(0.65, 1.4);
    shape.arm_length = factor(0.6, 1.6), shape.leg_length = factor(0.4, 1.4);
    shape.hand_size = factor(0.7, 2), shape.foot_size = factor(0.7, 1.8), shape.limb_girth = factor(0.65, 1.5);
    shape.shoulder_width = factor(0.75, 1.5), shape.hip_width = factor(0.75, 1.4);
    const BodyShape average = complete_shape(shape);
    const double index = average.weight / (average.height * average.height); // at least 15.5, see `proportions_of`
    shape.weight = average.weight * draw.factor(std::max(0.75, 13 / index), 1.7);
    return shape;
}

/// Limbs that are several times as long as they are thick can be told from the trunk and its bulges.
bool has_clear_limbs(const Proportions& p) {
    constexpr double least_slenderness = 2.2;
    const double heavy = 1 + 0.5 * std::max(0.0, p.fat);
    return p.thigh + p.calf > least_slenderness * 0.17 * heavy * p.limb_scale &&
           p.upper_arm + p.forearm > least_slenderness * 0.10 * heavy * p.limb_scale + 0.03 * p.scale;
}

BodyPieces drawn_pieces(Draw& draw, bool may_be_robot) {
    BodyPieces pieces;
    const double kind = draw.between(0, 1);
    if (may_be_robot && kind < 0.3) {
        pieces.limbs = LimbPieces::apart, pieces.gap = draw.between(0.35, 1);
        return pieces;
    }
    pieces.limbs = draw.one_of(std::array{LimbPieces::whole, LimbPieces::closed, LimbPieces::open});
    pieces.face = draw.is_one_in(2);
    pieces.seams = draw.is_one_in(3);
    pieces.clothes = pieces.limbs != LimbPieces::whole || draw.is_one_in(2); // what is carried is no limb's
    if (!pieces.face && !pieces.clothes) pieces.seams = true;
    return pieces;
}

/// What goes together. Long things hang straight down: only bodies that stand upright wear these.
std::vector<Garment> drawn_clothes(Draw& draw, std::string_view pose) {
    const bool stands = pose == "a" || pose == "t", is_upright = stands || pose == "walk" || pose == "stand";
    std::vector<Garment> worn;
    const auto wear = [&](const auto& choices) { return worn.emplace_back(draw.one_of(choices)); };
    bool is_rear_covered = false;
    if (is_upright && draw.is_one_in(4)) {
        const Garment below =
            stands ? wear(std::array{G::skirt, G::coat, G::wide_skirt}) : wear(std::array{G::skirt, G::coat});
        is_rear_covered = below != G::skirt;
    } else if (draw.is_one_in(3))
        worn.push_back(G::trousers);
    if (draw.is_one_in(4)) worn.push_back(G::boots);
    bool is_back_free = true;
    if (draw.is_one_in(4)) {
        const Garment behind =
            stands ? wear(std::array{G::rucksack, G::wings, G::cape}) : wear(std::array{G::rucksack, G::wings});
        is_rear_covered = is_rear_covered || behind == G::cape, is_back_free = false;
    }
    if (!is_rear_covered && draw.is_one_in(7)) worn.push_back(G::tail), is_back_free = false;
    if (draw.is_one_in(3)) {
        if (is_back_free && stands)
            wear(std::array{G::bun, G::long_hair, G::pony_tail, G::long_pony_tail});
        else
            wear(std::array{G::bun, G::long_hair});
    }
    if (draw.is_one_in(3)) wear(std::array{G::hat, G::helmet, G::horns});
    if (draw.is_one_in(10)) worn.push_back(G::mittens);
    if (draw.is_one_in(4)) wear(std::array{G::axe, G::staff, G::sword});
    if (draw.is_one_in(6)) wear(std::array{G::bow, G::shield});
    return worn;
}

/// The pose with a few degrees of its own at the large joints.
BodyPose varied(Draw& draw, BodyPose pose) {
    constexpr double most = 5;
    for (const J joint : {J::waist, J::neck, J::left_shoulder, J::right_shoulder, J::left_elbow, J::right_elbow,
                          J::left_hip, J::right_hip, J::left_knee, J::right_knee}) {
        const AngleRange limits = joint_limits(joint);
        JointAngles& angles = pose.at(joint);
        angles.bend = std::clamp(angles.bend + draw.between(-most, most), limits.low.bend, limits.high.bend);
        if (joint == J::left_shoulder || joint == J::right_shoulder) angles.side += draw.between(-most, most);
    }
    return pose;
}

/// How far parts are apart, with what each of them wears.
double clearance_in_clothes(BodyPlan plan, const Proportions& proportions) {
    plan.may_touch = true; // to be measured, not to be refused
    return dressed_field(plan, proportions).clearance();
}

/// Spreads the arms, and the legs a little, until parts are apart by `room`. \returns whether they are
bool spread(BodyPlan& plan, const Proportions& proportions, double room) {
    constexpr int most_steps = 14;
    const auto turn_out = [&plan](J joint, double degrees) {
        double& side = plan.pose.at(joint).side;
        side = std::min(side + degrees, joint_limits(joint).high.side);
    };
    for (int step = 0; step < most_steps; ++step) {
        if (clearance_in_clothes(plan, proportions) >= room) return true;
        for (const J shoulder : {J::left_shoulder, J::right_shoulder}) turn_out(shoulder, 2.5);
        for (const J hip : {J::left_hip, J::right_hip}) turn_out(hip, 0.8);
    }
    return false;
}

bool hold_random_pose(Draw& draw, BodyPlan& plan, const Proportions& proportions, double room) {
    constexpr int attempts = 200;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        plan.pose = random_pose(draw.seed());
        if (limb_clearance(plan) >= room && clearance_in_clothes(plan, proportions) >= room) return true;
    }
    return false;
}

std::string described(const BodyPlan& plan, std::string_view pose) {
    std::string name{pose};
    const BodyPieces& pieces = plan.pieces;
    if (pieces.limbs == LimbPieces::apart) name += "-robot";
    if (pieces.limbs == LimbPieces::closed) name += "-closed";
    if (pieces.limbs == LimbPieces::open) name += "-open";
    if (pieces.seams) name += "-seams";
    if (pieces.face) name += "-face";
    if (pieces.clothes && !plan.clothes.empty()) name += "-shells";
    for (const Garment garment : plan.clothes) name += "-" + garment_names()[static_cast<std::size_t>(garment)];
    return name;
}

/// Nothing where limbs cannot be told apart.
std::optional<BodyPlan> drawn_character(Draw& draw, std::uint64_t index) {
    constexpr std::array<std::string_view, 8> upright{"a", "a", "t", "t", "walk", "walk", "stand", "run"};
    const bool is_random = index % 4 == 3, is_in_pieces = index % 3 == 2;
    const std::string_view pose = is_random ? "random" : draw.one_of(upright);
    BodyPlan plan;
    plan.shape = drawn_shape(draw);
    const Proportions proportions = proportions_of(plan.shape);
    if (!has_clear_limbs(proportions)) return {};
    plan.faces = 2 * static_cast<int>(draw.factor(least_faces, 20000) / 2);
    if (draw.is_one_in(4)) plan.hands[0].digits = plan.hands[1].digits = 4;
    if (is_in_pieces) plan.pieces = drawn_pieces(draw, !is_random && pose != "run");
    if (plan.pieces.limbs != LimbPieces::apart) plan.clothes = drawn_clothes(draw, pose);

    constexpr int least_faces_for_rods = 12000; // coarser meshes tear what is as thin as a sword or a bow
    for (const Garment thin : {G::axe, G::bow, G::staff, G::sword})
        if (std::find(plan.clothes.begin(), plan.clothes.end(), thin) != plan.clothes.end())
            plan.faces = std::max(plan.faces, least_faces_for_rods);

    const double room = (plan.clothes.empty() ? 0.010 : 0.020) * proportions.scale; // metres for a body of 1.75 m
    if (is_random) {
        if (!hold_random_pose(draw, plan, proportions, room)) return {};
    } else {
        plan.pose = varied(draw, named_pose(pose));
        if (!spread(plan, proportions, room)) return {};
    }
    plan.may_touch = !plan.clothes.empty() || plan.pieces.any(); // what is carried touches, and so do coarse fingers
    plan.name = described(plan, pose);
    return plan;
}

} // namespace

BodyPlan character(std::uint64_t seed, std::uint64_t index) {
    constexpr std::uint64_t most_bodies = 1000;
    constexpr int attempts = 200;
    Draw draw(seed * most_bodies + index);
    for (int attempt = 0; attempt < attempts; ++attempt)
        if (std::optional<BodyPlan> plan = drawn_character(draw, index)) {
            const std::string digits = std::to_string(index);
            plan->name = std::string(3 - std::min<std::size_t>(3, digits.size()), '0') + digits + "-" + plan->name;
            return *std::move(plan);
        }
    throw Error(ErrorCode::internal, "no character was drawn whose limbs are apart");
}

} // namespace skelgen::synth
