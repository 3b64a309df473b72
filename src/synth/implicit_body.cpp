#include "implicit_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <skelgen/core/error.hpp>

#include "anatomy.hpp"

namespace skelgen::synth {
namespace {

constexpr double far_away = 1e3;
constexpr double pi = std::numbers::pi;
constexpr double widest_blend = 0.06; ///< of all joinings, for a body of 1.75 m

constexpr double cloth_blend = 0.006; ///< of clothes with what is below
constexpr double lip_blend = 0.003;   ///< of a mouth's cavity with the face

double radians(double degrees) { return degrees * pi / 180; }

constexpr std::array<PartName, 4> limb_roots{PartName::left_upper_arm, PartName::right_upper_arm, PartName::left_thigh,
                                             PartName::right_thigh};

/// 1 at the joint, falling smoothly to 0 at `range`.
double nearness(const Vec3& p, const Vec3& joint, double range) {
    const double x = (p - joint).squaredNorm() / (range * range);
    return x >= 1 ? 0.0 : (1 - x) * (1 - x);
}

double blend_around(const Vec3& p, const Joining& join) {
    return join.weak + (join.strong - join.weak) * nearness(p, join.joint, join.range);
}

Part limb_part(const Eigen::Isometry3d& frame, double side, std::vector<Blob> blobs, double length) {
    Part part;
    part.frame = frame;
    part.side = side;
    part.limb = true;
    part.length = length;
    part.blobs = std::move(blobs);
    return part;
}

/// Rings of points on a limb, as many as tell whether something touches it.
void probe_limb(Part& part, double from, double to) {
    const Tube& tube = outline(part.blobs);
    for (int i = 0; i <= 5; ++i) {
        const Ring ring = tube.ring(part.length * (from + (to - from) * i / 5));
        for (int k = 0; k < 8; ++k) {
            const double angle = 2 * pi * k / 8;
            part.probes.push_back(part.to_world({ring.side * std::cos(angle), ring.front * std::sin(angle), ring.at}));
        }
    }
}

/// Both ends of all rounded cones (fingers, toes, bones of the foot), on six sides.
void probe_cones(Part& part) {
    for (const Blob& blob : part.blobs)
        if (const auto* cone = std::get_if<RoundCone>(&blob.form))
            for (int axis = 0; axis < 3; ++axis)
                for (const double sign : {1.0, -1.0}) {
                    part.probes.push_back(part.to_world(cone->from + sign * cone->from_radius * Vec3::Unit(axis)));
                    part.probes.push_back(part.to_world(cone->to + sign * cone->to_radius * Vec3::Unit(axis)));
                }
}

constexpr std::size_t index(PartName name) { return static_cast<std::size_t>(name); }

} // namespace

Vec3 Part::to_local(const Vec3& world) const {
    Vec3 p = frame.linear().transpose() * (world - frame.translation());
    p.x() *= side;
    if (!limb) return p;
    p.z() = -p.z();
    if (twist != 0) {
        const double angle = twist * std::clamp(p.z(), 0.0, length);
        p = {std::cos(angle) * p.x() + std::sin(angle) * p.y(), std::cos(angle) * p.y() - std::sin(angle) * p.x(),
             p.z()};
    }
    return p;
}

Vec3 Part::to_world(const Vec3& local) const {
    Vec3 p = local;
    if (limb) {
        if (twist != 0) {
            const double angle = twist * std::clamp(p.z(), 0.0, length);
            p = {std::cos(angle) * p.x() - std::sin(angle) * p.y(), std::cos(angle) * p.y() + std::sin(angle) * p.x(),
                 p.z()};
        }
        p.z() = -p.z();
    }
    p.x() *= side;
    return frame * p;
}

double Part::distance_bound(const Vec3& world) const {
    double bound = std::numeric_limits<double>::infinity();
    for (const Capsule& capsule : hull) bound = std::min(bound, capsule(world));
    return bound;
}

ImplicitBody::ImplicitBody(const Proportions& p, const BodyPose& pose, const std::array<HandShape, 2>& hands)
    : skeleton_(pose_skeleton(p, pose)), spine_(skeleton_), scale_(p.scale) {
    const PosedSkeleton& s = skeleton_;
    const auto at = [&s](BodyJoint joint) { return s.position(joint); };
    const double heavy = std::max(0.0, p.fat), k = p.scale;
    const double wide = std::max({1.0, p.shoulder_factor, p.hip_factor});

    Part& body = parts_[index(PartName::trunk)];
    body.blobs = trunk(p, s);
    const auto hull = [&body](const Vec3& from, const Vec3& to, double from_radius, double to_radius) {
        body.hull.emplace_back(from, to, std::max(from_radius, to_radius));
    };
    hull(at(BodyJoint::left_hip), at(BodyJoint::right_hip), k * (0.16 + 0.14 * heavy), k * (0.16 + 0.14 * heavy));
    hull(at(BodyJoint::crotch), at(BodyJoint::waist), k * wide * (0.20 + 0.22 * heavy),
         k * wide * (0.18 + 0.24 * heavy));
    hull(at(BodyJoint::waist), at(BodyJoint::chest), k * wide * (0.18 + 0.24 * heavy),
         k * wide * (0.20 + 0.16 * heavy));
    hull(at(BodyJoint::left_shoulder), at(BodyJoint::right_shoulder), k * (0.10 + 0.06 * heavy),
         k * (0.10 + 0.06 * heavy));
    hull(at(BodyJoint::chest), at(BodyJoint::head), k * wide * (0.18 + 0.08 * heavy), 0.11 * p.head_scale);

    Part& skull = parts_[index(PartName::head)];
    skull.frame = s.frame(BodyJoint::head) * Eigen::Translation3d(skull_origin(p));
    skull.blobs = head(p);
    const double h = p.head_scale;
    skull.hull.emplace_back(skull.frame * Vec3(0, -0.03 * h, -0.01 * h), skull.frame * Vec3(0, 0, 0.075 * h),
                            0.115 * h);
    for (int i = 0; i < 12; ++i)
        for (const double z : {-0.03, 0.04, 0.11}) {
            const double angle = 2 * pi * i / 12;
            skull.probes.push_back(skull.frame * (h * Vec3(0.07 * std::cos(angle), -0.01 + 0.09 * std::sin(angle), z)));
        }
    extremities_[0] = skull.frame * (h * Vec3(0, -0.010, 0.165));

    build_arm(p, pose, hands[0], PartName::left_upper_arm, BodyJoint::left_shoulder, extremities_[1]);
    build_arm(p, pose, hands[1], PartName::right_upper_arm, BodyJoint::right_shoulder, extremities_[2]);
    build_leg(p, pose, PartName::left_thigh, BodyJoint::left_hip, extremities_[3]);
    build_leg(p, pose, PartName::right_thigh, BodyJoint::right_hip, extremities_[4]);
    for (Part& part : parts_) set_bounds(part.blobs);
    if (p.mouth > 0) mouth_ = mouth(p), set_bounds(mouth_);

    const auto join = [&](PartName part, BodyJoint joint, double range, double strong) {
        joining_[index(part)] = {at(joint), range * k, 0.003, strong * k};
    };
    join(PartName::head, BodyJoint::head, 0.14, 0.030);
    joining_[index(PartName::head)].joint = skull.frame.translation();
    for (const auto& [arm, shoulder] : {std::pair{PartName::left_upper_arm, BodyJoint::left_shoulder},
                                        {PartName::right_upper_arm, BodyJoint::right_shoulder}}) {
        join(arm, shoulder, 0.125, 0.040);
        join(next(arm, 1), next(shoulder, 1), 0.10, 0.020); // forearm, elbow
        join(next(arm, 2), next(shoulder, 2), 0.07, 0.016); // hand, wrist
    }
    for (const auto& [leg, hip] :
         {std::pair{PartName::left_thigh, BodyJoint::left_hip}, {PartName::right_thigh, BodyJoint::right_hip}}) {
        join(leg, hip, 0.18, 0.036);
        join(next(leg, 1), next(hip, 1), 0.13, 0.022); // calf, knee
        join(next(leg, 2), next(hip, 2), 0.11, 0.024); // foot, ankle
    }
}

void ImplicitBody::build_arm(const Proportions& p, const BodyPose& pose, const HandShape& shape, PartName first,
                             BodyJoint shoulder, Vec3& fingertip) {
    const auto at = [&](int step) { return skeleton_.position(next(shoulder, step)); };
    const double side = side_of(shoulder), heavy = std::max(0.0, p.fat), k = p.limb_scale;
    Part& upper = parts_[index(first)] = limb_part(skeleton_.frame(shoulder), side, upper_arm(p), p.upper_arm);
    Part& fore = parts_[index(first) + 1] = limb_part(skeleton_.frame(next(shoulder, 1)), side, forearm(p), p.forearm);
    Hand fist = hand(p, pose.at(next(shoulder, 3)), shape);
    Part& palm = parts_[index(first) + 2] =
        limb_part(skeleton_.frame(next(shoulder, 2)), side, std::move(fist.blobs), p.palm);
    fore.twist = radians(pose.at(next(shoulder, 2)).turn) / p.forearm;
    upper.hull.emplace_back(at(0), at(1), k * (0.085 + 0.06 * heavy));
    fore.hull.emplace_back(at(1), at(2), k * (0.055 + 0.03 * heavy));
    palm.hull.emplace_back(at(2), palm.frame * Vec3(0, 0, -0.12 * p.hand_scale), 0.09 * p.hand_scale);
    probe_limb(upper, 0.1, 1);
    probe_limb(fore, 0.1, 1);
    probe_limb(palm, 0.2, 1);
    probe_cones(palm);
    fingertip = palm.to_world(fist.fingertip);
    for (const HandDigit& digit : fist.digits) digits_.emplace_back(next(first, 2), digit);
    if (fist.held) held_.emplace_back(next(first, 2), *fist.held);
}

std::vector<DigitTruth> ImplicitBody::digits() const {
    std::vector<DigitTruth> out;
    for (std::size_t i = 0; i < digits_.size(); ++i) {
        const auto& [name, digit] = digits_[i];
        const Part& palm = part(name);
        const bool is_thumb = i == 0 || digits_[i - 1].first != name;
        DigitTruth& known = out.emplace_back();
        known.side = name == PartName::left_hand ? Side::left : Side::right;
        if (!is_thumb) known.digit = hands::all_digits[static_cast<std::size_t>(out[i - 1].digit) + 1];
        for (std::size_t k = 0; k < known.joints.size(); ++k) known.joints[k] = palm.to_world(digit.places[k]);
        known.tip = palm.to_world(digit.tip());
        if (is_thumb) continue;
        const auto is_filled = [&](std::size_t k) { return (*this)((known.joints[k] + out[i - 1].joints[k]) / 2) < 0; };
        known.is_fused = (digit.is_sunk && digits_[i - 1].second.is_sunk) || (is_filled(1) && is_filled(2));
    }
    return out;
}

void ImplicitBody::build_leg(const Proportions& p, const BodyPose& pose, PartName first, BodyJoint hip, Vec3& toe) {
    const auto at = [&](int step) { return skeleton_.position(next(hip, step)); };
    const double side = side_of(hip), heavy = std::max(0.0, p.fat), k = p.limb_scale;
    Part& upper = parts_[index(first)] = limb_part(skeleton_.frame(hip), side, thigh(p), p.thigh);
    Part& lower = parts_[index(first) + 1] = limb_part(skeleton_.frame(next(hip, 1)), side, calf(p), p.calf);
    Part& end = parts_[index(first) + 2];
    Foot sole = foot(p, pose.at(next(hip, 3)).bend);
    end.frame = skeleton_.frame(next(hip, 2)), end.side = side, end.blobs = std::move(sole.blobs);
    upper.hull.emplace_back(at(0), at(1), k * (0.12 + 0.09 * heavy));
    lower.hull.emplace_back(at(1), at(2), k * (0.07 + 0.04 * heavy));
    end.hull.emplace_back(end.frame * Vec3(0, 0.02 * p.foot_scale, -0.035 * p.foot_scale), at(3), 0.10 * p.foot_scale);
    probe_limb(upper, 0.1, 1);
    probe_limb(lower, 0.1, 1);
    probe_cones(end);
    toe = end.to_world(sole.toe);
}

void ImplicitBody::leave_out(BodyJoint joint) {
    const int j = static_cast<int>(joint);
    const std::array<std::pair<BodyJoint, PartName>, 4> limbs{{{BodyJoint::left_shoulder, PartName::left_upper_arm},
                                                               {BodyJoint::right_shoulder, PartName::right_upper_arm},
                                                               {BodyJoint::left_hip, PartName::left_thigh},
                                                               {BodyJoint::right_hip, PartName::right_thigh}}};
    for (const auto& [root, part] : limbs) {
        const int step = j - static_cast<int>(root);
        const bool leg = part >= PartName::left_thigh;
        if (step < (leg ? 1 : 0) || step > 2) continue;
        for (std::size_t i = index(part) + static_cast<std::size_t>(step); i < index(part) + 3; ++i)
            parts_[i].absent = true;
        return;
    }
    throw Error(ErrorCode::usage, "nothing can be left out from the " + std::string(joint_name(joint)) +
                                      " on: give a shoulder, elbow, wrist, knee or ankle");
}

void ImplicitBody::wear(PartName name, std::vector<Blob> layer, double thickness) {
    Part& part = parts_[index(name)];
    set_bounds(layer);
    part.clothes.push_back(std::move(layer));
    for (Capsule& capsule : part.hull) capsule = capsule.grown(thickness);
}

void ImplicitBody::carry(const Eigen::Isometry3d& frame, std::vector<Blob> blobs) {
    set_bounds(blobs);
    Part& thing = carried_.emplace_back();
    thing.frame = frame;
    for (const Blob& blob : blobs)
        if (blob.use == Use::add) {
            const Vec3 centre = frame * blob.bound.centre;
            thing.hull.emplace_back(centre, centre, blob.bound.radius);
        }
    thing.blobs = std::move(blobs);
}

Vec3 ImplicitBody::onto_trunk(Vec3 p) const {
    constexpr double step = 1e-4;
    for (int i = 0; i < 20; ++i) {
        const double value = part_value(PartName::trunk, p);
        Vec3 gradient;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 h = step * Vec3::Unit(axis);
            gradient[axis] = (part_value(PartName::trunk, p + h) - part_value(PartName::trunk, p - h)) / (2 * step);
        }
        if (gradient.squaredNorm() < 1e-6) break;
        p -= 0.7 * value / gradient.squaredNorm() * gradient;
    }
    return p;
}

double ImplicitBody::part_value(PartName name, const Vec3& p) const {
    const Part& part = parts_[index(name)];
    const Vec3 local = in_part(name, p);
    double field = evaluate(part.blobs, local, far_away);
    for (const std::vector<Blob>& layer : part.clothes)
        field = smooth_union(field, evaluate(layer, local, far_away), cloth_blend);
    return field;
}

double ImplicitBody::part_alone(PartName name, const Vec3& p) const {
    const double near = 0.05 * scale_, bound = part(name).distance_bound(p);
    return bound > near ? bound : part_value(name, p);
}

Vec3 ImplicitBody::in_part(PartName name, const Vec3& p) const {
    return name == PartName::trunk ? spine_.to_rest(p) : part(name).to_local(p);
}

Vec3 ImplicitBody::part_middle(PartName name) const {
    const auto between = [this](BodyJoint a, BodyJoint b) -> Vec3 {
        return 0.5 * (skeleton_.position(a) + skeleton_.position(b));
    };
    if (name == PartName::trunk) return between(BodyJoint::waist, BodyJoint::chest);
    if (name == PartName::head) return part(name).frame.translation();
    constexpr std::array<BodyJoint, 4> roots{BodyJoint::left_shoulder, BodyJoint::right_shoulder, BodyJoint::left_hip,
                                             BodyJoint::right_hip};
    const std::size_t limb = index(name) - index(PartName::left_upper_arm);
    const int step = static_cast<int>(limb % 3);
    return between(next(roots[limb / 3], step), next(roots[limb / 3], step + 1));
}

Ball ImplicitBody::part_bound(PartName name) const {
    const Vec3 middle = part_middle(name);
    double radius = 0;
    for (const Capsule& capsule : part(name).hull) radius = std::max(radius, capsule.farthest(middle));
    return {middle, radius};
}

double ImplicitBody::reach_of_carried(const Vec3& from) const {
    double reach = 0;
    for (const Part& thing : carried_)
        for (const Capsule& capsule : thing.hull) reach = std::max(reach, capsule.farthest(from));
    return reach;
}

double ImplicitBody::limb_value(PartName first, const Vec3& p, double limit) const {
    double field = far_away;
    for (std::size_t i = index(first); i < index(first) + 3; ++i) {
        const auto name = static_cast<PartName>(i);
        const Joining& join = joining_[i];
        if (parts_[i].absent || parts_[i].distance_bound(p) >= std::min(limit, field + join.strong)) continue;
        field = smooth_union(field, part_value(name, p), blend_around(p, join));
    }
    return field;
}

double ImplicitBody::operator()(const Vec3& p) const {
    // A part further away than this changes neither the sign nor, near the surface, the value.
    const double limit = 0.10 * scale_;
    std::array<double, 4> limbs{};
    for (std::size_t i = 0; i < limbs.size(); ++i) limbs[i] = limb_value(limb_roots[i], p, limit);
    const double nearest = std::min(limit, *std::min_element(limbs.begin(), limbs.end()) + widest_blend * scale_);

    double field = far_away, bound = part(PartName::trunk).distance_bound(p);
    if (bound < nearest) field = part_value(PartName::trunk, p);
    bound = std::min(bound, part(PartName::head).distance_bound(p));
    if (part(PartName::head).distance_bound(p) < nearest)
        field = smooth_union(field, part_value(PartName::head, p), blend_around(p, joining_[index(PartName::head)]));
    if (!mouth_.empty() && part(PartName::head).distance_bound(p) < nearest) // down into the neck, which is the trunk's
        field = smooth_intersection(field, -evaluate(mouth_, in_part(PartName::head, p), far_away), lip_blend);
    for (std::size_t i = 0; i < limbs.size(); ++i)
        field = smooth_union(field, limbs[i], blend_around(p, joining_[index(limb_roots[i])]));
    for (const Part& thing : carried_)
        if (thing.distance_bound(p) < std::min(limit, field + cloth_blend))
            field = smooth_union(field, evaluate(thing.blobs, thing.to_local(p), far_away), cloth_blend);
    if (field < far_away / 2) return field; // not that: blending two far values lowers them
    for (const Part& part : parts_) bound = std::min(bound, part.distance_bound(p));
    for (const Part& thing : carried_) bound = std::min(bound, thing.distance_bound(p));
    return std::max(bound, limit / 2);
}

double ImplicitBody::grain(const Vec3& p) const {
    const auto near = [this, &p](PartName name, double extra, double fine) {
        const double d = part(name).distance_bound(p) - extra * scale_;
        return std::lerp(fine, 1.0, std::clamp(d / (0.10 * scale_), 0.0, 1.0));
    };
    double grain = near(PartName::head, -0.02, 0.52);
    for (const PartName hand : {PartName::left_hand, PartName::right_hand})
        grain = std::min(grain, near(hand, -0.01, 0.36));
    for (const PartName foot : {PartName::left_foot, PartName::right_foot})
        grain = std::min(grain, near(foot, -0.02, 0.55));
    return grain;
}

double ImplicitBody::clearance() const {
    double gap = std::numeric_limits<double>::infinity();
    const auto test = [&](PartName probed, PartName field, std::size_t skip) {
        const Part& a = part(probed);
        for (std::size_t i = skip; i < a.probes.size(); ++i)
            if (part(field).distance_bound(a.probes[i]) < gap) gap = std::min(gap, part_value(field, a.probes[i]));
    };
    const auto both = [&](PartName a, PartName b) { test(a, b, 0), test(b, a, 0); };
    const std::array<PartName, 2> upper_arms{PartName::left_upper_arm, PartName::right_upper_arm};
    const std::array<PartName, 2> thighs{PartName::left_thigh, PartName::right_thigh};
    constexpr std::size_t ring = 8; // probes per ring of a limb: the first rings lie in the trunk by nature
    for (const PartName arm : upper_arms) {
        test(arm, PartName::trunk, 2 * ring);
        test(arm, PartName::head, ring);
        both(next(arm, 2), arm);
        for (const int step : {1, 2}) {
            test(next(arm, step), PartName::trunk, 0);
            both(next(arm, step), PartName::head);
            for (const PartName leg : thighs)
                for (const int down : {0, 1, 2}) both(next(arm, step), next(leg, down));
        }
    }
    for (const int a : {0, 1, 2})
        for (const int b : {0, 1, 2})
            if (a + b > 0) both(next(upper_arms[0], a), next(upper_arms[1], b));
    for (const PartName leg : thighs) {
        test(next(leg, 1), PartName::trunk, 0);
        test(next(leg, 2), PartName::trunk, 0);
        both(next(leg, 2), leg);
        for (const PartName arm : upper_arms) test(leg, arm, 0);
    }
    for (const int a : {0, 1, 2})
        for (const int b : {0, 1, 2})
            test(next(thighs[0], a), next(thighs[1], b), a == 0 ? ring : 0),
                test(next(thighs[1], b), next(thighs[0], a), b == 0 ? ring : 0);
    return gap;
}

} // namespace skelgen::synth
