#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/posing.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/shortest_turn.hpp>
#include <skelgen/core/shoulder_height.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// Directions as near to an axis of the coordinates are meant to be along it: 20 degrees, radians. A working value.
inline constexpr double near_axes = 20 * std::numbers::pi / 180;

namespace detail {

inline constexpr double degree = std::numbers::pi / 180;

/// Angle between two directions, radians.
template <typename Scalar>
Scalar angle_between(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// How a body stands, by the joints of its template, once it is turned upright and to face +z.
template <typename Scalar>
class Stance {
public:
    Stance(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
           const Orientations<Scalar>& now, const Eigen::Quaternion<Scalar>& to_canonical)
        : skeleton_(&skeleton), template_(&skeleton_template), rest_(rest_skeleton<Scalar>(skeleton_template)),
          now_(&now), to_canonical_(to_canonical) {}

    [[nodiscard]] bool is_present(int j) const {
        return j >= 0 && skeleton_->joints[static_cast<std::size_t>(j)].is_present;
    }
    /// The direction of a joint's bone.
    [[nodiscard]] Vector3<Scalar> bone(int j) const {
        const Vector3<Scalar> line =
            bone_end(*skeleton_, *template_, j) - skeleton_->joints[static_cast<std::size_t>(j)].position;
        return to_canonical_ * line.stableNormalized();
    }
    /// The same in the template's rest pose.
    [[nodiscard]] Vector3<Scalar> rest_bone(int j) const {
        return (bone_end(rest_, *template_, j) - rest_.joints[static_cast<std::size_t>(j)].position).stableNormalized();
    }
    /// The direction from one joint to another.
    [[nodiscard]] Vector3<Scalar> line(int from, int to) const { return to_canonical_ * line_in(*skeleton_, from, to); }
    /// The same in the template's rest pose.
    [[nodiscard]] Vector3<Scalar> rest_line(int from, int to) const { return line_in(rest_, from, to); }
    [[nodiscard]] Eigen::Quaternion<Scalar> turn(int j) const {
        return (to_canonical_ * (*now_)[static_cast<std::size_t>(j)]).normalized();
    }

    /// By how much the way from the root to the neck is off the vertical.
    [[nodiscard]] Scalar trunk_off_upright() const {
        const int neck = joint(JointRole::neck, Side::none);
        if (!is_present(neck)) return std::numbers::pi_v<Scalar>;
        const Vector3<Scalar> line =
            skeleton_->joints[static_cast<std::size_t>(neck)].position - skeleton_->joints.front().position;
        return angle_between<Scalar>(to_canonical_ * line, Vector3<Scalar>::UnitY());
    }

    /// Whether hips and shoulders lie across it, to so many radians.
    [[nodiscard]] bool faces_ahead(Scalar most) const {
        constexpr std::array across{JointRole::hip, JointRole::shoulder};
        return std::all_of(across.begin(), across.end(), [&](JointRole role) {
            const int left = joint(role, Side::left), right = joint(role, Side::right);
            return !is_present(left) || !is_present(right) ||
                   angle_between<Scalar>(line(right, left), Vector3<Scalar>::UnitX()) <= most;
        });
    }

    /// From the lowest of its joints and end points to the highest.
    [[nodiscard]] Scalar height() const {
        std::vector<Scalar> heights;
        for (const Joint<Scalar>& joint : skeleton_->joints)
            if (joint.is_present) heights.push_back((to_canonical_ * joint.position)[1]);
        for (const auto& [name, place] : skeleton_->end_points) heights.push_back((to_canonical_ * place)[1]);
        const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
        return heights.empty() ? Scalar(0) : *highest - *lowest;
    }

    /// How far a joint lies from the line between two others.
    [[nodiscard]] Scalar off_line(int j, int from, int to) const {
        const auto& joints = skeleton_->joints;
        const Vector3<Scalar> way =
            joints[static_cast<std::size_t>(j)].position - joints[static_cast<std::size_t>(from)].position;
        return (to_canonical_ * way).cross(line(from, to)).norm();
    }

    /// Does it stand in a T- or an A-pose, or between the two?
    [[nodiscard]] bool is_at_rest() const {
        constexpr Scalar trunk = Scalar(30 * degree), head = Scalar(45 * degree);
        for (std::size_t i = 0; i < template_->joints.size(); ++i) {
            const int j = static_cast<int>(i);
            const JointRole role = template_->joints[i].role;
            if (!is_present(j)) return false;
            if (part_of(role) == BodyPart::trunk) {
                const bool is_above = role == JointRole::neck || role == JointRole::head;
                if (angle_of(turn(j)) > (is_above ? head : trunk)) return false;
            }
        }
        return are_arms_at_rest() && are_legs_at_rest();
    }

    static Scalar angle_of(const Eigen::Quaternion<Scalar>& rotation) {
        return Eigen::Quaternion<Scalar>::Identity().angularDistance(rotation);
    }

private:
    [[nodiscard]] int joint(JointRole role, Side side) const { return find_joint(*template_, role, side); }
    static Vector3<Scalar> line_in(const KinematicSkeleton<Scalar>& skeleton, int from, int to) {
        const auto at = [&](int j) { return skeleton.joints[static_cast<std::size_t>(j)].position; };
        return (at(to) - at(from)).stableNormalized();
    }

    /// Whether the bones of a role are on both sides within so much of each other's mirror image.
    [[nodiscard]] bool are_alike(JointRole role, Scalar most) const {
        const int left = joint(role, Side::left), right = joint(role, Side::right);
        if (left < 0 || right < 0) return false;
        const Vector3<Scalar> across = bone(right);
        return angle_between<Scalar>(bone(left), Vector3<Scalar>(-across[0], across[1], across[2])) <= most;
    }

    [[nodiscard]] bool are_arms_at_rest() const {
        constexpr Scalar bend = Scalar(40 * degree), unlike = Scalar(25 * degree);
        constexpr Scalar highest = Scalar(0.35), foremost = Scalar(0.5); // by sines: of 20 and 30 degrees
        for (const Side side : {Side::left, Side::right}) {
            const int shoulder = joint(JointRole::shoulder, side), elbow = joint(JointRole::elbow, side);
            if (shoulder < 0 || elbow < 0) return false;
            const Vector3<Scalar> arm = bone(shoulder);
            if (angle_between<Scalar>(arm, bone(elbow)) > bend) return false;
            if (arm[1] > highest || std::abs(arm[2]) > foremost || arm[0] * Scalar(sign_of(side)) < 0) return false;
        }
        return are_alike(JointRole::shoulder, unlike) && are_alike(JointRole::elbow, unlike);
    }

    [[nodiscard]] bool are_legs_at_rest() const {
        constexpr Scalar off = Scalar(30 * degree), unlike = Scalar(25 * degree);
        for (const JointRole role : {JointRole::hip, JointRole::knee})
            for (const Side side : {Side::left, Side::right}) {
                const int j = joint(role, side);
                if (j < 0 || angle_between<Scalar>(bone(j), rest_bone(j)) > off) return false;
            }
        return are_alike(JointRole::hip, unlike) && are_alike(JointRole::knee, unlike);
    }

    const KinematicSkeleton<Scalar>* skeleton_;
    const SkeletonTemplate* template_;
    KinematicSkeleton<Scalar> rest_;
    const Orientations<Scalar>* now_;
    Eigen::Quaternion<Scalar> to_canonical_;
};

/// The orientations that joints get in a rest pose: as `orientations_in`, what is near enough as it is.
template <typename Scalar>
class RestTurns {
public:
    RestTurns(RestPose pose, const Stance<Scalar>& stance, const SkeletonTemplate& skeleton_template,
              const Orientations<Scalar>& now, const Eigen::Quaternion<Scalar>& to_canonical)
        : stance_(&stance), template_(&skeleton_template),
          wanted_(orientations_in(pose, skeleton_template, now, to_canonical)) {
        if (pose == RestPose::as_is) return;
        // Lines as long as the trunk say more than its joints do, some of which may have been found off.
        const double off = static_cast<double>(stance.trunk_off_upright()) / degree;
        const bool is_upright = off <= 15 && stance.faces_ahead(Scalar(30 * degree));
        stays_trunk_ = keep({JointRole::pelvis, JointRole::waist, JointRole::chest}, is_upright ? any : 15);
        keep({JointRole::neck, JointRole::head}, stays_trunk_ || off <= 25 ? any : 25);
        const bool are_legs_down = stays({JointRole::hip, JointRole::knee}, 35);
        keep_limbs(JointRole::hip, JointRole::knee, JointRole::ankle, 15);
        keep({JointRole::ankle, JointRole::foot}, are_legs_down ? any : 35);
        stays_arms_ = keep_limbs(JointRole::shoulder, JointRole::elbow, JointRole::wrist, 12);
        if (!stays_arms_)
            for (const Side side : {Side::left, Side::right}) swing_arm(side);
        for (const Side side : {Side::left, Side::right}) carry_hand(side);
    }

    [[nodiscard]] const Orientations<Scalar>& wanted() const { return wanted_; }
    /// Neither is asked of a body that is to be as it is.
    [[nodiscard]] bool stays_trunk() const { return stays_trunk_; }
    [[nodiscard]] bool stays_arms() const { return stays_arms_; }

private:
    static constexpr double any = 180; // degrees: whatever a joint does

    template <typename Use>
    void for_each(std::initializer_list<JointRole> roles, const Use& use) {
        for (std::size_t j = 0; j < wanted_.size(); ++j)
            if (std::find(roles.begin(), roles.end(), template_->joints[j].role) != roles.end())
                use(static_cast<int>(j), wanted_[j]);
    }

    /// Whether all joints of these roles are within so many degrees of where they are wanted; arms and legs by their
    /// directions, as how a straight one is turned about itself is hardly seen.
    [[nodiscard]] bool stays(std::initializer_list<JointRole> roles, double degrees) {
        const auto most = static_cast<Scalar>(degrees * degree);
        bool out = true;
        for_each(roles, [&](int j, const Eigen::Quaternion<Scalar>& wanted) {
            const JointRole role = template_->joint(j).role;
            const bool by_direction = part_of(role) != BodyPart::trunk && role < JointRole::ankle;
            const Vector3<Scalar> bone = stance_->rest_bone(j);
            const Scalar off = by_direction ? angle_between<Scalar>(stance_->turn(j) * bone, wanted * bone)
                                            : Scalar(stance_->turn(j).angularDistance(wanted));
            out = out && off <= most;
        });
        return out;
    }

    bool keep(std::initializer_list<JointRole> roles, double degrees) {
        if (!stays(roles, degrees)) return false;
        for_each(roles, [&](int j, Eigen::Quaternion<Scalar>& wanted) { wanted = stance_->turn(j); });
        return true;
    }

    /// Keeps limbs of both sides whose lines from the first joint to the last are within so many degrees of where they
    /// are wanted, and that hardly bend: bones of short limbs turn far with a joint that was found off.
    bool keep_limbs(JointRole first, JointRole middle, JointRole last, double degrees) {
        // Of the height: elbows and knees of 37 characters in T-poses are found within 0.03, of 36 within 0.022.
        constexpr Scalar bent = Scalar(0.05);
        const auto most = static_cast<Scalar>(degrees * degree);
        for (const Side side : {Side::left, Side::right}) {
            const int from = find_joint(*template_, first, side), to = find_joint(*template_, last, side);
            const int between = find_joint(*template_, middle, side);
            if (!stance_->is_present(from) || !stance_->is_present(between) || !stance_->is_present(to)) continue;
            const Vector3<Scalar> wanted = wanted_[static_cast<std::size_t>(from)] * stance_->rest_line(from, to);
            if (angle_between<Scalar>(stance_->line(from, to), wanted) > most) return false;
            if (stance_->off_line(between, from, to) > bent * stance_->height()) return false;
        }
        return keep({first, middle}, any);
    }

    /// What a joint does to what is fixed to it.
    [[nodiscard]] Eigen::Quaternion<Scalar> motion(int j) const {
        return wanted_[static_cast<std::size_t>(j)] * stance_->turn(j).conjugate();
    }

    /// Has a joint go with its parent, `carried`, and then by the least turn that lays its bone where it is wanted.
    void swing(int j, const Eigen::Quaternion<Scalar>& carried) {
        Eigen::Quaternion<Scalar>& wanted = wanted_[static_cast<std::size_t>(j)];
        const Vector3<Scalar> to = wanted * stance_->rest_bone(j);
        wanted = core::shortest_turn<Scalar>(carried * stance_->bone(j), to) * carried * stance_->turn(j);
        wanted.normalize();
    }

    /// A nearly straight arm shows not how it is turned about itself: so it does not turn about itself. It is swung as
    /// one, by its line, and then each bone. Both bones by themselves would twist a bent elbow, and turn the palm.
    void swing_arm(Side side) {
        constexpr Scalar straight = Scalar(60 * degree);
        const int shoulder = find_joint(*template_, JointRole::shoulder, side);
        const int elbow = find_joint(*template_, JointRole::elbow, side);
        if (!stance_->is_present(shoulder) || !stance_->is_present(elbow)) return;
        if (angle_between<Scalar>(stance_->bone(shoulder), stance_->bone(elbow)) > straight) return;
        const int wrist = find_joint(*template_, JointRole::wrist, side);
        const int end = stance_->is_present(wrist) ? wrist : elbow;
        const Vector3<Scalar> to = wanted_[static_cast<std::size_t>(shoulder)] * stance_->rest_line(shoulder, end);
        const Eigen::Quaternion<Scalar> chest = motion(template_->joint(shoulder).parent);
        const Eigen::Quaternion<Scalar> arm =
            core::shortest_turn<Scalar>(chest * stance_->line(shoulder, end), to) * chest;
        swing(shoulder, arm);
        swing(elbow, arm);
    }

    /// Hands go with the forearms. A bent wrist of an arm that is moved is straightened, but not turned about the arm;
    /// of a body at rest, which bends no wrist so, it was found off.
    void carry_hand(Side side) {
        constexpr Scalar bent = Scalar(45 * degree);
        const int elbow = find_joint(*template_, JointRole::elbow, side);
        const int wrist = find_joint(*template_, JointRole::wrist, side);
        const int hand = find_joint(*template_, JointRole::hand, side);
        if (!stance_->is_present(elbow) || !stance_->is_present(wrist)) return;
        const bool is_bent = !stays_arms_ && !stance_->is_at_rest() &&
                             angle_between<Scalar>(stance_->bone(elbow), stance_->bone(wrist)) > bent;
        const auto follow = [&](int j, const Eigen::Quaternion<Scalar>& carried) {
            wanted_[static_cast<std::size_t>(j)] = (carried * stance_->turn(j)).normalized();
        };
        if (is_bent)
            swing(wrist, motion(elbow));
        else
            follow(wrist, motion(elbow));
        if (hand >= 0) follow(hand, motion(wrist));
    }

    const Stance<Scalar>* stance_;
    const SkeletonTemplate* template_;
    Orientations<Scalar> wanted_;
    bool stays_trunk_ = false, stays_arms_ = false;
};

/// How much higher the shoulders go, of a body at rest, when its arms are raised from where they are to `raised`, both
/// as the cosine between upper arm and trunk.
template <typename Scalar>
Scalar rise_of_shoulders(const KinematicSkeleton<Scalar>& rest, const SkeletonTemplate& skeleton_template,
                         const Stance<Scalar>& stance, Scalar raised) {
    const auto height_of = [&](JointRole role) {
        Scalar sum = 0, count = 0;
        for (std::size_t j = 0; j < rest.joints.size(); ++j)
            if (skeleton_template.joints[j].role == role && rest.joints[j].is_present) {
                sum += rest.joints[j].position[1];
                count += 1;
            }
        return count > 0 ? std::optional<Scalar>(sum / count) : std::nullopt;
    };
    const auto neck = height_of(JointRole::neck), hips = height_of(JointRole::hip);
    if (!neck || !hips) return 0;
    Scalar now = 0, arms = 0;
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j)
        if (skeleton_template.joints[j].role == JointRole::shoulder && stance.is_present(static_cast<int>(j))) {
            now += stance.bone(static_cast<int>(j))[1];
            arms += 1;
        }
    if (arms == 0) return 0;
    return (*neck - *hips) *
           (core::usual_shoulder_height(raised, Scalar(0)) - core::usual_shoulder_height(now / arms, Scalar(0)));
}

} // namespace detail

/// Of a rotation that about y which leaves what looks ahead, along z, in the same vertical plane.
template <typename Scalar>
Eigen::Quaternion<Scalar> about_vertical(const Eigen::Quaternion<Scalar>& rotation) {
    const Vector3<Scalar> ahead = rotation * Vector3<Scalar>::UnitZ();
    return Eigen::Quaternion<Scalar>(
        Eigen::AngleAxis<Scalar>(std::atan2(ahead[0], ahead[2]), Vector3<Scalar>::UnitY()));
}

/// The rotation that takes axes to axes and is within 20 degrees of this one: a scene that is upright, or has another
/// axis up or ahead, stays as level as it is. None where none is so near.
template <typename Scalar>
std::optional<Eigen::Quaternion<Scalar>> along_axes(const Eigen::Quaternion<Scalar>& rotation) {
    constexpr Scalar near = Scalar(near_axes);
    const Eigen::Matrix3<Scalar> matrix = rotation.toRotationMatrix();
    Eigen::Matrix3<Scalar> axes = Eigen::Matrix3<Scalar>::Zero();
    for (int column = 0; column < 3; ++column) {
        Eigen::Index row = 0;
        matrix.col(column).cwiseAbs().maxCoeff(&row);
        axes(row, column) = matrix(row, column) < 0 ? Scalar(-1) : Scalar(1);
    }
    if (axes.determinant() != 1) return std::nullopt; // two columns are nearest to the same axis
    const Eigen::Quaternion<Scalar> nearest(axes);
    if (nearest.angularDistance(rotation) > near) return std::nullopt;
    return nearest;
}

/// The pose of a body as `bone_orientations`, but where it stands in a T- or an A-pose, both sides alike, as those do
/// who were made to be moved: there trunk, head and soles are taken to be as the template has them at rest, whatever
/// the bones in them say (the way from ankle to ball is not the sole's, that from chin to crown not the face's), arms
/// to be turned from the T-pose by the least that leads to their directions, and hands as the forearms are.
/// `to_canonical`: turns the body upright and to face +z. O(joints^2). \throws Error as `bone_orientations`.
template <typename Scalar>
Orientations<Scalar> posture(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                             const Eigen::Quaternion<Scalar>& to_canonical) {
    using Rotation = Eigen::Quaternion<Scalar>;
    Orientations<Scalar> out = bone_orientations(skeleton, skeleton_template);
    const Orientations<Scalar> seen = out;
    const detail::Stance<Scalar> stance(skeleton, skeleton_template, seen, to_canonical);
    if (!stance.is_at_rest()) return out;
    const Rotation back = to_canonical.conjugate();
    for (std::size_t i = 0; i < out.size(); ++i) {
        const int j = static_cast<int>(i);
        const TemplateJoint& joint = skeleton_template.joints[i];
        const auto of_side = [&](JointRole role) {
            return out[static_cast<std::size_t>(find_joint(skeleton_template, role, joint.side))];
        };
        switch (joint.role) {
        case JointRole::shoulder:
        case JointRole::elbow:
            out[i] = back * core::shortest_turn<Scalar>(stance.rest_bone(j), stance.bone(j));
            break;
        case JointRole::wrist:
        case JointRole::hand:
            out[i] = of_side(JointRole::elbow);
            break;
        case JointRole::ankle:
            out[i] = back * about_vertical<Scalar>(stance.turn(j));
            break;
        case JointRole::foot:
            out[i] = of_side(JointRole::ankle);
            break;
        case JointRole::hip:
        case JointRole::knee:
            break; // a leg's direction is that of its bones
        default:
            out[i] = back;
        }
        out[i].normalize();
    }
    return out;
}

/// As `rest_motions`, but what lies within some degrees of the rest pose stays as it is. The trunk does where its line
/// is within 15 degrees, and hips and shoulders lie across within 30, else where its joints are within 15. Arms (12)
/// and legs (15) of both sides do by the lines from their first joint to their last, where elbows or knees lie near
/// these. Soles stay within 35, or whatever they do below legs that are down within 35. The head stays within 25, or
/// whatever it does where the trunk is upright within 25. These two stay as they are turned in the world. Hands of arms
/// that stay do so, too. Arms that are bent by less than 60 degrees are laid where they are wanted without a turn about
/// themselves, and hands go with the forearms. Arms that are raised or lowered take the shoulders along as people's do.
/// `now`: as of `posture`. O(joints). \throws Error as `rest_motions`.
template <typename Scalar>
std::vector<RigidMotion<Scalar>>
posture_motions(RestPose pose, const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                const Orientations<Scalar>& now, const Eigen::Quaternion<Scalar>& to_canonical) {
    const Vector3<Scalar> origin = Vector3<Scalar>::Zero();
    const detail::Stance<Scalar> stance(skeleton, skeleton_template, now, to_canonical);
    const detail::RestTurns<Scalar> turns(pose, stance, skeleton_template, now, to_canonical);
    const auto level = motions<Scalar>(skeleton, now, turns.wanted(), origin);
    if (pose == RestPose::as_is || turns.stays_arms()) return level;
    if (!turns.stays_trunk()) {
        const Orientations<Scalar> upright(now.size(), Eigen::Quaternion<Scalar>::Identity());
        const auto lines =
            girdle_lines(skeleton, now, rest_skeleton<Scalar>(skeleton_template), upright, skeleton_template);
        return motions<Scalar>(skeleton, now, turns.wanted(), origin, lines);
    }
    const Scalar raised = pose == RestPose::a_pose ? -std::numbers::sqrt2_v<Scalar> / 2 : Scalar(0);
    const Scalar higher =
        detail::rise_of_shoulders<Scalar>(moved(skeleton, skeleton_template, level), skeleton_template, stance, raised);
    return motions<Scalar>(
        skeleton, now, turns.wanted(), origin,
        detail::with_shoulders_higher(detail::lines_from_parents(skeleton), higher, level, skeleton_template));
}

} // namespace skelgen::applications
