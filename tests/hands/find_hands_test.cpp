#include <skelgen/hands/find_hands.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <skelgen/core/shortest_turn.hpp>
#include <skelgen/surface/prepare.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"
#include "hand_shape.hpp"
#include "mesh_changes.hpp"

using namespace skelgen;
using namespace skelgen::test;
using hands::Digit;

namespace {

template <typename Scalar>
std::vector<hands::Hand<Scalar>> hands_in(const Mesh& mesh, const KinematicSkeleton<Scalar>& skeleton) {
    const TriangleMesh<Scalar> own{mesh.vertices.cast<Scalar>(), mesh.faces};
    return hands::find_hands(own, surface::prepare(own), skeleton);
}

std::vector<Digit> digits_of(const hands::Hand<double>& hand) {
    std::vector<Digit> out;
    for (const auto& digit : hand.digits) out.push_back(digit.digit);
    return out;
}

std::vector<TubeDigit> five_digits(double curl = 0) {
    std::vector<TubeDigit> out{thumb()};
    for (const TubeDigit& digit : four_fingers(curl)) out.push_back(digit);
    return out;
}

hands::Hand<double> only_hand(const std::vector<TubeDigit>& digits) {
    const auto found = hands_in(hand_of(digits), arm_skeleton());
    REQUIRE(found.size() == 1);
    return found.front();
}

} // namespace

TEMPLATE_TEST_CASE("five digits of a hand are found, named and divided", "[hands]", float, double) {
    const std::vector<TubeDigit> digits = five_digits();
    const auto found = hands_in(hand_of(digits), arm_skeleton<TestType>());
    REQUIRE(found.size() == 1);
    CHECK(found[0].side == Side::left);
    REQUIRE(found[0].digits.size() == 5);
    for (std::size_t d = 0; d < 5; ++d) {
        INFO(hands::name_of(hands::all_digits[d]));
        const hands::FoundDigit<TestType>& digit = found[0].digits[d];
        CHECK(digit.digit == hands::all_digits[d]);
        CHECK(digit.fused.empty());
        CHECK((digit.tip.template cast<double>() - digits[d].tip()).norm() < 0.03);
        CHECK(digit.confidence > 0.7);
        const bool is_thumb = d == 0; // whose web is far from its joints here
        for (std::size_t k = is_thumb ? 1 : 0; k < hands::phalanges; ++k) {
            const Vec3 place = digit.joints[k].template cast<double>();
            std::vector<Vec3> axis = digits[d].places;
            axis.front() += (axis[0] - axis[1]) / 2; // how far behind the web a knuckle is, is checked below
            double off_axis = 1;
            for (std::size_t i = 1; i < axis.size(); ++i)
                off_axis = std::min(off_axis, segment_distance(place, axis[i - 1], axis[i]));
            CHECK(off_axis < 0.025);
            if (!is_thumb) CHECK((place - digits[d].places[k]).norm() < 0.06);
        }
        for (std::size_t k = 1; k < hands::phalanges; ++k)
            CHECK(std::abs(static_cast<double>(digit.radii[k]) - digits[d].radius) < 0.01);
    }
}

TEST_CASE("where there are fewer digits, the last ones are missing", "[hands]") {
    CHECK(digits_of(only_hand({thumb(), finger(0.15, 0.4, 0.1), finger(0, 0.42, 0), finger(-0.15, 0.35, -0.1)})) ==
          std::vector{Digit::thumb, Digit::index, Digit::middle, Digit::ring});
    CHECK(digits_of(only_hand(four_fingers())) == std::vector{Digit::index, Digit::middle, Digit::ring, Digit::little});
}

TEST_CASE("digits that are one on the surface are one chain that says so", "[hands]") {
    const auto wide = [](double across, double length) { return TubeDigit{finger(across, length, 0).places, 0.06}; };
    const std::vector<TubeDigit> mitten{thumb(), wide(0.12, 0.42), wide(0.04, 0.45), wide(-0.04, 0.43),
                                        wide(-0.12, 0.4)};
    const hands::Hand<double> hand = only_hand(mitten);
    REQUIRE(digits_of(hand) == std::vector{Digit::thumb, Digit::index});
    CHECK(hand.digits[0].fused.empty());
    CHECK(hand.digits[1].fused.size() >= 2);
    CHECK(hands::fused_digits<double>({hand}).at(0).first == "left_index_1");
    CHECK(hands::has_digits<double>({hand}));

    const hands::Hand<double> fist = only_hand({});
    REQUIRE(digits_of(fist) == std::vector{Digit::index});
    CHECK(fist.digits[0].fused == std::vector{Digit::middle, Digit::ring, Digit::little});
    CHECK_FALSE(hands::has_digits<double>({fist}));
}

TEST_CASE("a finger beside the thumb alone is one, though its tube begins in the palm", "[hands]") {
    const hands::Hand<double> hand = only_hand({thumb(), finger(0, 0.42, 0)});
    REQUIRE(digits_of(hand) == std::vector{Digit::thumb, Digit::index});
    CHECK(hand.digits[1].fused.empty());
}

TEST_CASE("a finger that is thicker than the thumb, and round, is one", "[hands]") {
    TubeDigit thick = finger(0, 0.5, 0);
    thick.radius = 0.09;
    const hands::Hand<double> hand = only_hand({thumb(), thick});
    REQUIRE(digits_of(hand) == std::vector{Digit::thumb, Digit::index});
    CHECK(hand.digits[1].fused.empty());
}

TEST_CASE("two fingers that have grown together are told by their width", "[hands]") {
    std::vector<TubeDigit> digits = five_digits();
    digits[3] = finger(-0.02, 0.44, 0); // ring beside middle
    digits[2].places = finger(0.045, 0.45, 0).places;
    const hands::Hand<double> hand = only_hand(digits);
    REQUIRE(digits_of(hand) == std::vector{Digit::thumb, Digit::index, Digit::middle, Digit::little});
    CHECK(hand.digits[2].fused == std::vector{Digit::ring});
}

TEST_CASE("fingers bend towards the palm, on both sides", "[hands]") {
    const Mesh mesh = hand_of(five_digits(0.6));
    const auto left = hands_in(mesh, arm_skeleton()), right = hands_in(mirrored(mesh), arm_skeleton(Side::right));
    REQUIRE(left.size() == 1);
    REQUIRE(right.size() == 1);
    REQUIRE(left[0].digits.size() == 5);
    REQUIRE(right[0].digits.size() == 5);
    for (std::size_t d = 1; d < 5; ++d) {
        INFO(hands::name_of(hands::all_digits[d]));
        CHECK(left[0].digits[d].hinge.dot(-Vec3::UnitZ()) > 0.95);
        CHECK(right[0].digits[d].hinge.dot(Vec3::UnitZ()) > 0.95);
        CHECK((left[0].digits[d].tip.cwiseProduct(Vec3(-1, 1, 1)) - right[0].digits[d].tip).norm() < 0.03);
    }
}

TEST_CASE("a hand that is turned, moved, scaled and shuffled has the same digits", "[hands]") {
    const Mesh mesh = hand_of(five_digits(0.3));
    const KinematicSkeleton<double> skeleton = arm_skeleton();
    const Motion motion{random_rotation(3), 170, Vec3(40, -3, 1000)};
    KinematicSkeleton<double> there = skeleton;
    for (Joint<double>& joint : there.joints) joint.position = motion.apply(joint.position);
    for (auto& [name, place] : there.end_points) place = motion.apply(place);
    const auto before = hands_in(mesh, skeleton), after = hands_in(shuffled(moved(mesh, motion), 5), there);
    REQUIRE(before.size() == 1);
    REQUIRE(after.size() == 1);
    REQUIRE(digits_of(before[0]) == digits_of(after[0]));
    for (std::size_t d = 0; d < before[0].digits.size(); ++d) {
        const auto &a = before[0].digits[d], &b = after[0].digits[d];
        for (std::size_t k = 0; k < hands::phalanges; ++k)
            CHECK((motion.apply(a.joints[k]) - b.joints[k]).norm() < 1e-9 * motion.scale);
        CHECK((motion.rotation * a.hinge - b.hinge).norm() < 1e-6);
    }
}

TEST_CASE("a hand of many pieces is one", "[hands]") {
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> faces;
    const auto add = [&](const Vec3& from, const Vec3& to, double radius) {
        const Mesh piece = capsule(radius, (to - from).norm(), 12, 6);
        const Eigen::Quaterniond turn = core::shortest_turn<double>(Vec3::UnitZ(), to - from);
        const int first = static_cast<int>(vertices.size());
        for (Eigen::Index v = 0; v < piece.vertices.rows(); ++v)
            vertices.emplace_back(from + turn * Vec3(piece.vertices.row(v)));
        for (Eigen::Index f = 0; f < piece.faces.rows(); ++f)
            faces.push_back({first + piece.faces(f, 0), first + piece.faces(f, 1), first + piece.faces(f, 2)});
    };
    add(Vec3(-0.7, 0, 0), Vec3::Zero(), 0.15);
    for (const double across : {0.15, 0.05, -0.05, -0.15}) add(Vec3(0, 0, across / 3), Vec3(0.48, 0, across), 0.09);
    for (const TubeDigit& digit : five_digits())
        for (std::size_t i = 1; i < digit.places.size(); ++i) add(digit.places[i - 1], digit.places[i], digit.radius);
    const auto found = hands_in(make_mesh(vertices, faces), arm_skeleton());
    REQUIRE(found.size() == 1);
    CHECK(digits_of(found[0]).size() == 5);
}

TEST_CASE("prongs of a thing that a hand holds are no digits", "[hands]") {
    // One whose prongs are far from the knuckles, and one that bends back to them.
    const bool is_bent = GENERATE(false, true);
    const Vec3 held(is_bent ? 0.4 : 0, 0, 0), below = held + Vec3(0, is_bent ? -0.85 : -1.05, 0);
    const Vec3 fork = below + Vec3(is_bent ? 0.5 : 0, 0, 0), out(is_bent ? 0.15 : 0, is_bent ? 0 : -0.25, 0);
    const Vec3 side(0, 0, 0.25);
    const Mesh mesh = hand_of({thumb(), finger(0.1, 0.4, 0.1), finger(-0.1, 0.4, -0.1)},
                              {{held, below}, {below, fork}, {fork, fork + out + side}, {fork, fork + out - side}});
    const auto found = hands_in(mesh, arm_skeleton());
    REQUIRE(found.size() == 1);
    CHECK(digits_of(found[0]) == std::vector{Digit::thumb, Digit::index, Digit::middle});
}

TEST_CASE("a fist around a pole has its five digits, though they touch it and the tip is near the wrist", "[hands]") {
    const Mesh hand = hand_of(five_digits(0.9)), pole = capsule(0.12, 5, 16, 4);
    const Eigen::Index n = hand.vertices.rows(), m = hand.faces.rows();
    Mesh both;
    both.vertices.resize(n + pole.vertices.rows(), 3);
    both.vertices.topRows(n) = hand.vertices;
    both.vertices.bottomRows(pole.vertices.rows()) = pole.vertices.rowwise() + Eigen::RowVector3d(0.68, -0.16, -2.5);
    both.faces.resize(m + pole.faces.rows(), 3);
    both.faces.topRows(m) = hand.faces;
    both.faces.bottomRows(pole.faces.rows()) = pole.faces.array() + static_cast<int>(n);
    KinematicSkeleton<double> skeleton = arm_skeleton();
    skeleton.end_points.front().second = Vec3(0.75, 0, 0); // where the fist ends
    const auto found = hands_in(both, skeleton);
    REQUIRE(found.size() == 1);
    CHECK(digits_of(found[0]).size() == 5);
}

TEST_CASE("a skeleton gets the joints of all digits, and loses them again", "[hands]") {
    KinematicSkeleton<double> skeleton = arm_skeleton();
    skeleton.joints.push_back({"right_wrist", -1, Vec3(-1, 0, 0)});
    const auto found = hands_in(hand_of({thumb(), finger(0.1, 0.4, 0.1), finger(-0.1, 0.4, -0.1)}), skeleton);
    const KinematicSkeleton<double> all = hands::with_digits(skeleton, found);
    CHECK(all.template_name == "human51");
    REQUIRE(all.joints.size() == skeleton.joints.size() + 30);
    for (std::size_t j = 0; j < all.joints.size(); ++j) CHECK(all.joints[j].parent < static_cast<int>(j));
    const auto joint = [&](const std::string& name) { return joint_named(all, name); };
    CHECK(joint("left_index_1").is_present);
    CHECK(all.joints.at(static_cast<std::size_t>(joint("left_index_1").parent)).name == "left_wrist");
    CHECK(all.joints.at(static_cast<std::size_t>(joint("left_index_3").parent)).name == "left_index_2");
    CHECK_FALSE(joint("left_ring_1").is_present);
    CHECK(joint("left_ring_1").confidence == 0);
    CHECK_FALSE(joint("right_thumb_1").is_present);
    const auto has_end = [&](const std::string& name) {
        return std::any_of(all.end_points.begin(), all.end_points.end(),
                           [&](const auto& p) { return p.first == name; });
    };
    CHECK(has_end("left_middle_tip"));
    CHECK_FALSE(has_end("left_ring_tip"));

    const KinematicSkeleton<double> again = hands::without_digits(all);
    CHECK(again.template_name == "human21");
    REQUIRE(again.joints.size() == skeleton.joints.size());
    for (std::size_t j = 0; j < again.joints.size(); ++j) {
        CHECK(again.joints[j].name == skeleton.joints[j].name);
        CHECK(again.joints[j].parent == skeleton.joints[j].parent);
    }
    CHECK(again.end_points.size() == skeleton.end_points.size());
}

TEST_CASE("where the arm ends before the hand, no digits are looked for", "[hands]") {
    KinematicSkeleton<double> skeleton = arm_skeleton();
    skeleton.joints.back().is_present = false;
    CHECK(hands_in(hand_of(five_digits()), skeleton).empty());
}
