#include <cmath>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/refinement/thickness_profile.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::refinement;

namespace {

/// A calf and a thigh as they swell and thin from toe (u = -1) over ankle (0) and knee (1) to hip (2); any unit.
double leg_thickness(double u) {
    const auto bump = [&](double centre, double width, double height) {
        return height * std::exp(-(u - centre) * (u - centre) / (2 * width * width));
    };
    return std::exp(-0.33 + bump(-0.1, 0.1, 0.29) + bump(0.65, 0.22, 0.5) + 0.95 * std::max(0.0, u - 0.7));
}

/// human21's left leg laid out straight, with a thickness that belongs to an ankle and a knee at these distances from
/// the tip.
Limb<double> leg(double ankle, double knee, double stoutness) {
    const SkeletonTemplate& human = builtin_template("human21");
    Limb<double> limb;
    double from_tip = 0;
    for (int j = static_cast<int>(human.joints.size()) - 1; j >= 0; --j) {
        const TemplateJoint& joint = human.joints[static_cast<std::size_t>(j)];
        if (joint.side != Side::left) continue;
        if (joint.role == JointRole::foot)
            from_tip = (*joint.tip - joint.position).norm();
        else if (joint.role == JointRole::ankle || joint.role == JointRole::knee || joint.role == JointRole::hip)
            from_tip += (joint.position - human.joints[static_cast<std::size_t>(limb.joints.front())].position).norm();
        else
            continue;
        limb.joints.insert(limb.joints.begin(), j);
        limb.from_tip.insert(limb.from_tip.begin(), from_tip);
    }
    const double length = 1.05 * limb.from_tip.front(), step = 0.01;
    const auto n = static_cast<Eigen::Index>(length / step) + 1;
    limb.line.points = Points<double>::Zero(n, 3);
    limb.line.arc = Eigen::VectorXd::LinSpaced(n, 0, step * static_cast<double>(n - 1));
    limb.line.points.col(0) = limb.line.arc;
    limb.line.thickness.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double d = limb.line.arc[n - 1] - limb.line.arc[i];
        const double u = d < ankle  ? d / ankle - 1
                         : d < knee ? (d - ankle) / (knee - ankle)
                                    : 1 + (d - knee) / (knee - ankle);
        limb.line.thickness[i] = stoutness * leg_thickness(u);
    }
    limb.line.area = limb.line.thickness;
    limb.line.flatness = Eigen::VectorXd::Zero(n);
    return limb;
}

/// The same leg bent at its knee: its centreline cuts the corner there, and the sections on the way are thick of both
/// bones' flesh.
Limb<double> bent(Limb<double> limb, double knee, double degrees) {
    const double cut = 0.2 * (limb.from_tip[0] - limb.from_tip[1]), angle = degrees * 3.14159265358979 / 180;
    const Eigen::RowVector3d up(-1, 0, 0), down(std::cos(angle), std::sin(angle), 0); // from the knee
    const Eigen::VectorXd from_tip = limb.line.arc[limb.line.arc.size() - 1] - limb.line.arc.array();
    for (Eigen::Index i = 0; i < from_tip.size(); ++i) {
        const double above = from_tip[i] - knee, part = (above / cut + 1) / 2;
        limb.line.points.row(i) = above > 0 ? Eigen::RowVector3d(above * up) : Eigen::RowVector3d(-above * down);
        if (part <= 0 || part >= 1) continue;
        limb.line.points.row(i) = cut * ((1 - part) * down + part * up);
        limb.line.thickness[i] *= 1.3;
        limb.line.flatness[i] = 1;
    }
    for (Eigen::Index i = 1; i < from_tip.size(); ++i)
        limb.line.arc[i] = limb.line.arc[i - 1] + (limb.line.points.row(i) - limb.line.points.row(i - 1)).norm();
    return limb;
}

std::vector<Limb<double>> matched(const std::vector<Limb<double>>& limbs) {
    return match_thickness_profiles(limbs, builtin_template("human21")).limbs;
}

} // namespace

TEST_CASE("the knee is found where the calf's and the thigh's thickness puts it, whatever the stoutness") {
    const Limb<double> rest = leg(0.2, 0.6, 1);
    const double ankle = rest.from_tip[2], knee = rest.from_tip[1];
    double reference = 0;
    for (const double stoutness : {0.05, 0.08, 1.0}) {
        std::vector<Limb<double>> limbs{leg(ankle, knee, stoutness)};
        limbs = matched(limbs);
        if (reference == 0) reference = limbs[0].from_tip[1];
        CHECK(limbs[0].from_tip[1] == Approx(reference).epsilon(1e-9));
        CHECK(limbs[0].from_tip[1] == Approx(knee).epsilon(0.06));
    }
    for (const double longer : {0.92, 1.08}) { // calves that are shorter and longer than the template's
        std::vector<Limb<double>> limbs{leg(ankle, ankle + longer * (knee - ankle), 0.07)};
        const auto [found, ratio] = match_thickness_profiles(limbs, builtin_template("human21"));
        limbs = found;
        INFO("calf " << longer);
        CHECK((limbs[0].from_tip[1] - reference) / ((longer - 1) * (knee - ankle)) == Approx(1).margin(0.4));
        CHECK(ratio == Approx((limbs[0].from_tip[1] - limbs[0].from_tip[2]) / (knee - ankle)));
        const double thigh = (limbs[0].from_tip[0] - limbs[0].from_tip[1]) / (rest.from_tip[0] - knee);
        CHECK(std::log(thigh) / std::log(ratio) > 0.4); // the thigh with it, half as much
        CHECK(std::log(thigh) / std::log(ratio) < 1);
    }
}

TEST_CASE("where the trunk tells the upper end of the thigh, the thigh is as long as that, unless it is far off") {
    const Limb<double> rest = leg(0.2, 0.6, 1);
    const double ankle = rest.from_tip[2], knee = rest.from_tip[1], hip = rest.from_tip[0];
    const auto thigh_with_top = [&](double top, double deviation) {
        std::vector<Limb<double>> limbs{leg(ankle, knee, 0.05)};
        limbs[0].top_by_trunk = top;
        limbs[0].top_deviation = deviation;
        limbs = matched(limbs);
        return limbs[0].from_tip[0];
    };
    std::vector<Limb<double>> plain{leg(ankle, knee, 0.05)};
    plain = matched(plain);
    const double without = plain[0].from_tip[0], sharp = 0.02 * (hip - knee);
    for (const double part : {-0.1, 0.1}) {
        const double top = without + part * (hip - knee);
        CHECK((thigh_with_top(top, sharp) - without) / (top - without) == Approx(0.9).margin(0.2));
        CHECK(std::abs(thigh_with_top(top, 30 * sharp) - without) <
              0.2 * std::abs(top - without)); // who is not sure, is not heard
    }
    const double hidden = knee + 0.1 * (hip - knee); // by a coat
    CHECK(thigh_with_top(hidden, sharp) == Approx(without).epsilon(0.08));
}

TEST_CASE(
    "an arm that shows nothing is, by half, as much longer than the template's as the legs are; a figure's is not") {
    const Limb<double> rest = leg(0.2, 0.6, 1);
    const double ankle = rest.from_tip[2], knee = rest.from_tip[1];
    Limb<double> arm =
        limb_along<double>({Vec3::Zero(), Vec3::UnitX()},
                           {joint_of(JointRole::shoulder, Side::left), joint_of(JointRole::elbow, Side::left),
                            joint_of(JointRole::wrist, Side::left), joint_of(JointRole::hand, Side::left)},
                           {0.7, 0.45, 0.2, 0.1});
    arm.line.thickness.setZero();
    for (const double longer : {0.9, 1.1}) {
        SkeletonTemplate human = builtin_template("human21");
        const std::vector<Limb<double>> limbs{leg(ankle, ankle + longer * (knee - ankle), 0.05), arm};
        const auto person = match_thickness_profiles(limbs, human).limbs;
        const double calf = (person[0].from_tip[1] - person[0].from_tip[2]) / (knee - ankle);
        for (std::size_t i = 1; i < arm.from_tip.size(); ++i)
            CHECK(person[1].from_tip[i] == Approx(std::sqrt(calf) * arm.from_tip[i]).epsilon(1e-5));
        human.is_adapted = true;
        CHECK(match_thickness_profiles(limbs, human).limbs[1].from_tip[1] == Approx(arm.from_tip[1]).epsilon(1e-6));
    }
}

TEST_CASE("both legs' calves are equally long") {
    const Limb<double> rest = leg(0.2, 0.6, 1);
    const double ankle = rest.from_tip[2], calf = rest.from_tip[1] - ankle;
    std::vector<Limb<double>> limbs{leg(ankle, ankle + 0.95 * calf, 0.05),
                                    leg(1.1 * ankle, 1.1 * ankle + 1.05 * calf, 0.05)};
    limbs = matched(limbs);
    const auto found_calf = [&](std::size_t i) { return limbs[i].from_tip[1] - limbs[i].from_tip[2]; };
    CHECK(found_calf(0) == Approx(found_calf(1)));
    CHECK(found_calf(0) == Approx(calf).epsilon(0.06));
    CHECK(limbs[1].from_tip[2] > 1.03 * limbs[0].from_tip[2]); // each foot in its own shoe
}

TEST_CASE("a bent leg's ankle is where a straight one's is, and its calf as long") {
    const Limb<double> rest = leg(0.2, 0.6, 1);
    const double ankle = rest.from_tip[2], knee = rest.from_tip[1];
    std::vector<Limb<double>> straight{leg(ankle, knee, 0.05)};
    straight = matched(straight);
    for (const double degrees : {90.0, 120.0}) {
        INFO("bent by " << degrees << " degrees");
        const Limb<double> leg_before = bent(leg(ankle, knee, 0.05), knee, degrees);
        const Fold<double> fold = find_fold(leg_before, {ankle, knee, leg_before.from_tip[0]});
        CHECK(fold.bent == 1);
        CHECK(fold.longer > 0.05 * knee);
        CHECK(fold.along_bones(ankle) == ankle);
        CHECK(fold.along_bones(fold.farther) == Approx(fold.farther + fold.longer));
        const auto found = match_thickness_profiles<double>({leg_before}, builtin_template("human21"));
        CHECK(found.limbs[0].from_tip[2] == Approx(straight[0].from_tip[2]).epsilon(0.03));
        CHECK(found.ratio ==
              Approx((straight[0].from_tip[1] - straight[0].from_tip[2]) / (knee - ankle)).epsilon(0.06));
        const auto as_if_straight =
            match_thickness_profiles<double>({leg_before}, builtin_template("human21"), {}, {178, 179});
        CHECK(as_if_straight.ratio < 0.98 * found.ratio);
    }
    CHECK(find_fold(straight[0], {ankle, knee, straight[0].from_tip[0]}).bent == 0);
}

TEST_CASE("a leg without a section of its own follows the other one") {
    const Limb<double> rest = leg(0.2, 0.6, 1);
    const double ankle = rest.from_tip[2], calf = rest.from_tip[1] - ankle;
    std::vector<Limb<double>> alone{leg(ankle, ankle + 1.05 * calf, 0.05)}, both = alone, none;
    both.push_back(both[0]);
    both[1].line.thickness.setZero();
    none = {both[1], both[1]};
    for (std::vector<Limb<double>>* limbs : {&alone, &both, &none}) *limbs = matched(*limbs);
    const auto found_calf = [](const Limb<double>& limb) { return limb.from_tip[1] - limb.from_tip[2]; };
    CHECK(found_calf(both[0]) == Approx(found_calf(both[1])));
    CHECK(found_calf(both[0]) > calf);
    CHECK(found_calf(alone[0]) > found_calf(both[0])); // which says that it is as usual
    CHECK(found_calf(none[0]) == Approx(calf));
}

TEST_CASE("a coat moves a limb's attachment outwards, a fold does not") {
    const Limb<double> rest = leg(0.2, 0.6, 1);
    const double ankle = rest.from_tip[2], knee = rest.from_tip[1], thigh = rest.from_tip[0] - knee;
    const auto attachment = [&](double from, double to) { // parts of the thigh that are thick, from the knee
        std::vector<Limb<double>> limbs{leg(ankle, knee, 0.05)};
        Centreline<double>& line = limbs[0].line;
        const double end = line.arc[line.arc.size() - 1];
        for (Eigen::Index i = 0; i < line.arc.size(); ++i) {
            const double part = (end - line.arc[i] - knee) / thigh;
            if (part > from && part < to) line.thickness[i] *= 2;
        }
        limbs = matched(limbs);
        return (end - limbs[0].attachment - knee) / thigh;
    };
    const double untouched = attachment(2, 3);
    CHECK(attachment(0.5, 2) == Approx(0.5).margin(0.1));
    CHECK(attachment(0.3, 0.5) == Approx(untouched).margin(0.05));
}

TEST_CASE("a head has no such profile: it stays as it was, and says nothing of the scale") {
    const SkeletonTemplate& human = builtin_template("human21");
    Limb<double> head = leg(0.2, 0.6, 1);
    head.joints.clear();
    for (std::size_t j = 0; j < human.joints.size(); ++j)
        if (human.joints[j].role == JointRole::neck || human.joints[j].role == JointRole::head)
            head.joints.push_back(static_cast<int>(j));
    head.from_tip = {0.28, 0.2};
    std::vector<Limb<double>> limbs{head};
    const auto found = match_thickness_profiles(limbs, human);
    CHECK(found.ratio == 1);
    CHECK(found.limbs[0].from_tip == head.from_tip);
}

TEST_CASE("in float the joints are found in the same places") {
    const Limb<double> rest = leg(0.2, 0.6, 1);
    const double ankle = rest.from_tip[2], knee = rest.from_tip[1];
    const std::vector<Limb<double>> limbs{leg(ankle, ankle + 0.93 * (knee - ankle), 0.06)};
    Limb<float> rounded;
    rounded.joints = limbs[0].joints;
    rounded.from_tip.assign(limbs[0].from_tip.begin(), limbs[0].from_tip.end());
    const Centreline<double>& line = limbs[0].line;
    rounded.line = {line.points.cast<float>(), line.arc.cast<float>(), line.thickness.cast<float>(),
                    line.area.cast<float>(), line.flatness.cast<float>()};
    const auto exact = match_thickness_profiles(limbs, builtin_template("human21"));
    const auto found = match_thickness_profiles(std::vector{rounded}, builtin_template("human21"));
    CHECK(found.ratio == Approx(exact.ratio).epsilon(1e-5));
    for (std::size_t i = 0; i < rounded.from_tip.size(); ++i)
        CHECK(found.limbs[0].from_tip[i] == Approx(exact.limbs[0].from_tip[i]).epsilon(1e-5));
}

TEST_CASE("deviations of nothing are refused: one divides by them") {
    CHECK_NOTHROW(validate(ThicknessProfileOptions{}));
    ThicknessProfileOptions options;
    options.thickness_deviation = 0;
    CHECK_THROWS_AS(validate(options), Error);
}
