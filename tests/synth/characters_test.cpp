#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/synth/sets.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "synth/body_surface.hpp"
#include "synth/characters.hpp"
#include "synth/surface_mesher.hpp"

using namespace skelgen;
using namespace skelgen::synth;
using G = Garment;
using J = BodyJoint;

namespace {

/// All that a plan of the set has, to be compared.
std::string text_of(const BodyPlan& plan) {
    std::ostringstream out;
    out.precision(17);
    const BodyShape& s = plan.shape;
    out << plan.name << ' ' << plan.faces << ' ' << plan.may_touch;
    for (const double value :
         {s.age, s.masculinity, s.height, s.weight, s.muscle, s.arm_length, s.leg_length, s.torso_length, s.head_size,
          s.hand_size, s.foot_size, s.limb_girth, s.shoulder_width, s.hip_width, s.mouth, plan.pieces.gap})
        out << ' ' << value;
    for (const JointAngles& angles : plan.pose.angles)
        out << ' ' << angles.bend << ' ' << angles.side << ' ' << angles.turn;
    for (const Garment garment : plan.clothes) out << ' ' << static_cast<int>(garment);
    out << ' ' << static_cast<int>(plan.pieces.limbs) << plan.pieces.seams << plan.pieces.face << plan.pieces.clothes
        << plan.hands[0].digits << plan.hands[1].digits;
    return out.str();
}

int count_of(const BodyPlan& plan, const std::vector<Garment>& garments) {
    return static_cast<int>(std::count_if(plan.clothes.begin(), plan.clothes.end(), [&](Garment worn) {
        return std::find(garments.begin(), garments.end(), worn) != garments.end();
    }));
}

BodyPlan standing() {
    BodyPlan plan;
    plan.pose = spread_limbs(plan.shape, named_pose("a"));
    plan.faces = 5000;
    return plan;
}

/// An adult of average proportions, naked and with one thing.
class Dressed {
public:
    explicit Dressed(Garment garment) {
        BodyPlan plan = standing();
        proportions_ = proportions_of(plan.shape);
        naked_.push_back(naked_field(plan, proportions_));
        plan.clothes = {garment};
        dressed_.push_back(dressed_field(plan, proportions_));
    }

    [[nodiscard]] bool grows_at(const Vec3& p) const { return naked_[0](p) > 0 && dressed_[0](p) < 0; }

    /// Whether it grows anywhere straight behind a place.
    [[nodiscard]] bool grows_behind(const Vec3& p) const {
        for (int i = 0; i < 100; ++i)
            if (grows_at(p + Vec3(0, 0.005 * i, 0))) return true;
        return false;
    }

    [[nodiscard]] Vec3 at(J joint) const { return naked_[0].skeleton().position(joint); }
    [[nodiscard]] const Part& part(PartName name) const { return naked_[0].part(name); }
    [[nodiscard]] const Proportions& proportions() const { return proportions_; }

private:
    Proportions proportions_;
    std::vector<ImplicitBody> naked_, dressed_; // one each
};

} // namespace

TEST_CASE("characters are a hundred, the same for the same seed") {
    const std::vector<BodyPlan> plans = body_set("characters", 1), again = body_set("characters", 1),
                                other = body_set("characters", 2);
    REQUIRE(plans.size() == 100);
    REQUIRE(other.size() == 100);
    std::set<std::string> names, texts;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        names.insert(plans[i].name);
        texts.insert(text_of(plans[i])), texts.insert(text_of(other[i]));
        CHECK(text_of(plans[i]) == text_of(again[i]));
    }
    CHECK(names.size() == 100);
    CHECK(texts.size() == 200);
    for (const std::size_t i : {0U, 7U, 99U})
        CHECK(text_of(character(1, i)) == text_of(plans[i])); // whatever others are
}

TEST_CASE("characters keep to the ranges, and wear what goes together") {
    std::map<std::string, int> poses;
    int in_pieces = 0;
    std::map<LimbPieces, int> kinds;
    std::map<Garment, int> worn;
    for (const BodyPlan& plan : body_set("characters", 1)) {
        INFO(plan.name);
        CHECK_NOTHROW(check_shape(plan.shape));
        CHECK_NOTHROW(check_pose(plan.pose));
        CHECK(plan.faces >= least_faces);
        CHECK(plan.faces <= 20000);
        CHECK(plan.shape.head_size >= 0.8);
        CHECK(plan.shape.head_size <= 3);
        CHECK(limb_clearance(plan) > 0);
        CHECK(count_of(plan, {G::axe, G::staff, G::sword}) <= 1); // in the right hand
        CHECK(count_of(plan, {G::bow, G::shield}) <= 1);          // on the left arm
        CHECK(count_of(plan, {G::hat, G::helmet, G::horns}) <= 1);
        CHECK(count_of(plan, {G::bun, G::long_hair, G::pony_tail, G::long_pony_tail}) <= 1);
        CHECK(count_of(plan, {G::rucksack, G::wings, G::cape, G::tail, G::pony_tail, G::long_pony_tail}) <= 2);
        CHECK(count_of(plan, {G::coat, G::skirt, G::wide_skirt, G::trousers}) <= 1);
        CHECK((plan.pieces.limbs != LimbPieces::apart || plan.clothes.empty()));
        ++poses[plan.name.substr(4, plan.name.find('-', 4) - 4)];
        in_pieces += plan.pieces.any();
        ++kinds[plan.pieces.limbs];
        for (const Garment garment : plan.clothes) ++worn[garment];
    }
    CHECK(poses["random"] == 25);
    CHECK(poses.size() == 6);
    CHECK(in_pieces == 33);
    CHECK(kinds.size() == 4);
    CHECK(worn.size() == garment_names().size());
}

TEST_CASE("hair, helmet, wings, cape and wide skirt are where they are worn") {
    const Dressed bun(G::bun), helmet(G::helmet);
    const double h = bun.proportions().head_scale, k = bun.proportions().scale;
    CHECK(bun.grows_at(bun.part(PartName::head).to_world(h * Vec3(0, 0.13, 0.15))));
    CHECK(helmet.grows_at(helmet.part(PartName::head).to_world(h * Vec3(0, 0, 0.18))));
    CHECK_FALSE(helmet.grows_at(helmet.part(PartName::head).to_world(h * Vec3(0, -0.135, 0)))); // before the face

    const Dressed hair(G::pony_tail), long_hair(G::long_pony_tail), cape(G::cape);
    const Vec3 waist = hair.at(J::waist), thighs = (hair.at(J::left_hip) + hair.at(J::right_knee)) / 2;
    const Vec3 calves = (hair.at(J::left_knee) + hair.at(J::right_ankle)) / 2;
    CHECK(hair.grows_behind(waist));
    CHECK_FALSE(hair.grows_behind(thighs));
    CHECK(long_hair.grows_behind(thighs));
    CHECK(long_hair.grows_behind(calves));
    for (const double side : {-1.0, 0.0, 1.0}) CHECK(cape.grows_behind(thighs + Vec3(0.1 * k * side, 0, 0)));
    CHECK_FALSE(cape.grows_behind(calves));

    const Dressed skirt(G::wide_skirt), wings(G::wings);
    CHECK(skirt.grows_at((skirt.at(J::left_ankle) + skirt.at(J::right_ankle)) / 2 + Vec3(0, 0, 0.1 * k)));
    for (const double side : {-1.0, 1.0})
        CHECK(wings.grows_behind(wings.at(J::chest) + k * Vec3(0.5 * side, 0.1, 0.3)));
}

TEST_CASE("shield and bow are on the left arm") {
    const Dressed shield(G::shield), bow(G::bow);
    const double k = shield.proportions().scale;
    const Part &fore = shield.part(PartName::left_forearm), &hand = bow.part(PartName::left_hand);
    for (const double across : {-0.2, 0.2}) {
        bool grows = false;
        for (int i = 0; i < 20; ++i)
            grows = grows || shield.grows_at(fore.frame * Vec3(0.01 * i, across * k, -0.6 * fore.length));
        CHECK(grows);
    }
    for (const double along : {-0.5, 0.5})
        CHECK(bow.grows_at(hand.to_world(k * Vec3(0, -along, 0.075 - 0.7 * along * along))));
}

TEST_CASE("new things are one surface with the body") {
    BodyPlan plan = standing();
    plan.clothes = {G::wings, G::helmet, G::shield};
    const Topology topology = topology_of(synthesize_body(plan).mesh);
    CHECK(topology.closed_manifold);
    CHECK(topology.components == 1);
    CHECK(topology.euler == 2);
}

TEST_CASE("a robot is made of closed pieces that do not touch") {
    BodyPlan plan = standing();
    plan.pieces.limbs = LimbPieces::apart;
    const SynthBody robot = synthesize_body(plan);
    const auto& vertices = robot.mesh.vertices;
    CHECK(topology_of(robot.mesh).components == 15); // pelvis and chest are two
    CHECK(test::is_closed(robot.mesh.faces));
    CHECK(robot.truth.digits.empty());
    CHECK(robot.truth.end_points.size() == 5);

    core::DisjointSets pieces(static_cast<std::size_t>(vertices.rows()));
    for (Eigen::Index f = 0; f < robot.mesh.faces.rows(); ++f)
        for (const int k : {1, 2})
            pieces.unite(static_cast<std::size_t>(robot.mesh.faces(f, 0)),
                         static_cast<std::size_t>(robot.mesh.faces(f, k)));
    std::map<std::size_t, double> gaps; // from each piece to the next one
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        for (Eigen::Index w = 0; w < v; ++w) {
            const std::size_t a = pieces.find(static_cast<std::size_t>(v)),
                              b = pieces.find(static_cast<std::size_t>(w));
            if (a == b) continue;
            const double gap = (vertices.row(v) - vertices.row(w)).norm();
            for (const std::size_t piece : {a, b}) {
                const auto place = gaps.try_emplace(piece, gap).first;
                place->second = std::min(place->second, gap);
            }
        }
    for (const auto& [piece, gap] : gaps) {
        CHECK(gap > 0.01);
        CHECK(gap < 0.15); // metres: a thigh's thickness
    }
}
