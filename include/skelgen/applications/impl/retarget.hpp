#pragma once

#include <skelgen/applications/retarget.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/clip_body.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/shortest_turn.hpp>

namespace skelgen::applications {
namespace detail {

/// Which joints of a clip a joint of the template goes by.
struct ClipGuides {
    std::vector<int> turned_by; ///< it turns as the mean of these
    int from = -1, to = -1;     ///< its bone points as from one to the other; -1 where it does not
};

inline const ClipLimb& limb_of(const ClipBody& body, const TemplateJoint& joint) {
    const std::size_t side = joint.side == Side::left ? 0 : 1;
    return part_of(joint.role) == BodyPart::arm ? body.arms[side] : body.legs[side];
}

inline ClipGuides guides_of(const ClipBody& body, const TemplateJoint& joint) {
    switch (joint.role) {
    case JointRole::pelvis:
        return {{body.pelvis}};
    case JointRole::waist:
        return {body.spine.empty() ? std::vector<int>{body.pelvis, body.chest} : body.spine};
    case JointRole::chest:
        return {{body.chest}};
    case JointRole::neck:
        return {body.neck.empty() ? std::vector<int>{body.chest, body.head} : body.neck};
    case JointRole::head:
        return {{body.head}};
    default:
        break;
    }
    const ClipLimb& limb = limb_of(body, joint);
    switch (joint.role) {
    case JointRole::shoulder:
    case JointRole::hip:
        return {{limb.upper}, limb.upper, limb.lower};
    case JointRole::elbow:
    case JointRole::knee:
        return {{limb.lower}, limb.lower, limb.end};
    case JointRole::wrist:
    case JointRole::ankle:
        return {{limb.end}};
    default:
        return {{limb.tip >= 0 ? limb.tip : limb.end}};
    }
}

/// The mean of a few turns that are not far from each other.
inline Eigen::Quaterniond mean_turn(const ClipPose& pose, const std::vector<int>& joints) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (const int j : joints) {
        const Eigen::Vector4d turn = pose.turns[static_cast<std::size_t>(j)].coeffs();
        sum += turn.dot(sum) < 0 ? Eigen::Vector4d(-turn) : turn;
    }
    return Eigen::Quaterniond(sum).normalized();
}

/// The directions of a clip's body in one pose.
class ClipShape {
public:
    ClipShape(const ClipBody& body, const ClipPose& pose) : body_(&body), pose_(&pose) {}

    [[nodiscard]] const Vector3<double>& at(int joint) const {
        return pose_->positions[static_cast<std::size_t>(joint)];
    }
    [[nodiscard]] Vector3<double> between_hips() const { return middle(body_->legs, &ClipLimb::upper); }
    [[nodiscard]] Vector3<double> to_left() const { return at(body_->legs[0].upper) - at(body_->legs[1].upper); }
    [[nodiscard]] Vector3<double> along_trunk() const { return at(body_->head) - between_hips(); }
    [[nodiscard]] Vector3<double> along_legs() const { return middle(body_->legs, &ClipLimb::end) - between_hips(); }
    [[nodiscard]] Vector3<double> upwards() const { return along_trunk() - along_legs(); }

    /// Mean of the directions in which the feet point; zero where one has no tip.
    [[nodiscard]] Vector3<double> along_feet() const {
        Vector3<double> sum = Vector3<double>::Zero();
        for (const ClipLimb& leg : body_->legs) {
            if (leg.tip < 0) return Vector3<double>::Zero();
            sum += (at(leg.tip) - at(leg.end)).stableNormalized() / 2;
        }
        return sum;
    }

    /// Thigh and calf, mean of both sides.
    [[nodiscard]] double leg_length() const {
        double sum = 0;
        for (const ClipLimb& leg : body_->legs)
            sum += (at(leg.lower) - at(leg.upper)).norm() + (at(leg.end) - at(leg.lower)).norm();
        return sum / 2;
    }

    /// Whether legs and trunk lie apart, and the hips across them, as a body's do that stands, sits or lies.
    [[nodiscard]] bool shows_body() const {
        const Vector3<double> trunk = along_trunk().stableNormalized(), left = to_left().stableNormalized();
        return trunk.dot(along_legs().stableNormalized()) < 0 && !left.isZero(0) && std::abs(left.dot(trunk)) < 0.5;
    }

    /// Whether it stands upright along `up`, legs straight, feet forwards and both sides alike: as people stand in the
    /// rest poses of animators. What is tolerated: 15 degrees, and a tenth of the height between the sides.
    [[nodiscard]] bool stands_symmetric(const Vector3<double>& up) const {
        constexpr double aligned = 0.966;
        const Vector3<double> left = (to_left() - to_left().dot(up) * up).stableNormalized();
        bool stands = along_trunk().stableNormalized().dot(up) > aligned;
        for (const ClipLimb& leg : body_->legs) {
            stands = stands && (at(leg.lower) - at(leg.end)).stableNormalized().dot(up) > aligned &&
                     (at(leg.upper) - at(leg.lower)).stableNormalized().dot(up) > aligned;
        }
        const Vector3<double> feet = along_feet();
        if (!feet.isZero(0)) stands = stands && feet.dot(left.cross(up)) > 0.5;
        return stands && unlikeness(left) < upwards().norm() / 10;
    }

    /// The skeleton as one of the template's.
    [[nodiscard]] KinematicSkeleton<double> as_template(const MotionClip& clip,
                                                        const SkeletonTemplate& skeleton_template) const {
        KinematicSkeleton<double> out;
        out.template_name = skeleton_template.name;
        for (const TemplateJoint& joint : skeleton_template.joints) {
            const Vector3<double> place = place_of(joint);
            out.joints.push_back({joint.name, joint.parent, place});
            const auto last = static_cast<std::size_t>(guides_of(*body_, joint).turned_by.back());
            if (ends_limb(joint.role) && clip.joints[last].end)
                out.end_points.emplace_back(end_point_name(skeleton_template, joint),
                                            at(static_cast<int>(last)) + pose_->turns[last] * *clip.joints[last].end);
        }
        out.frame.origin = between_hips();
        out.frame.up = along_trunk().stableNormalized();
        out.frame.left = to_left().stableNormalized();
        out.frame.forward = out.frame.left.cross(out.frame.up);
        return out;
    }

private:
    [[nodiscard]] Vector3<double> middle(const std::array<ClipLimb, 2>& limbs, int ClipLimb::*joint) const {
        return (at(limbs[0].*joint) + at(limbs[1].*joint)) / 2;
    }

    /// The largest distance between a joint and that of the other side, mirrored.
    [[nodiscard]] double unlikeness(const Vector3<double>& left) const {
        double most = 0;
        for (const auto* limbs : {&body_->arms, &body_->legs})
            for (const auto joint : {&ClipLimb::upper, &ClipLimb::lower, &ClipLimb::end}) {
                Vector3<double> mirrored = at((*limbs)[0].*joint) - between_hips();
                mirrored -= 2 * mirrored.dot(left) * left;
                most = std::max(most, (between_hips() + mirrored - at((*limbs)[1].*joint)).norm());
            }
        return most;
    }

    /// Of joints that the clip lacks: halfway between those beside it; of a hand on from the forearm.
    [[nodiscard]] Vector3<double> place_of(const TemplateJoint& joint) const {
        if (joint.role == JointRole::waist && body_->spine.empty()) return (at(body_->pelvis) + at(body_->chest)) / 2;
        if (joint.role == JointRole::neck && body_->neck.empty()) return (at(body_->chest) + at(body_->head)) / 2;
        if (joint.role == JointRole::hand && limb_of(*body_, joint).tip < 0) {
            const ClipLimb& arm = limb_of(*body_, joint);
            return at(arm.end) + (at(arm.end) - at(arm.lower)) / 3;
        }
        return at(guides_of(*body_, joint).turned_by.front());
    }

    const ClipBody* body_;
    const ClipPose* pose_;
};

/// The axis of the coordinates, or its opposite, that is nearest to a direction.
inline Vector3<double> nearest_axis(const Vector3<double>& direction) {
    Eigen::Index axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    return Vector3<double>::Unit(axis) * (direction[axis] < 0 ? -1.0 : 1.0);
}

/// A pose of a clip in which it is known how its body is held.
struct ClipReference {
    ClipPose pose;
    Eigen::Quaterniond to_canonical; ///< from the clip's coordinates to +y up
    Orientations<double> held;       ///< per joint of the template, as `bone_orientations`, in the clip's
};

/// How the template's joints are held by a body that stands in a rest pose: trunk and feet as the template's, the bones
/// of limbs swung to where they point, hands as the forearms.
inline Orientations<double> held_at_rest(const ClipBody& body, const ClipShape& shape,
                                         const SkeletonTemplate& skeleton_template,
                                         const Eigen::Quaterniond& from_canonical) {
    const Orientations<double> axes = rest_axes<double>(skeleton_template);
    Orientations<double> held;
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const ClipGuides guides = guides_of(body, joint);
        const bool is_of_arm = part_of(joint.role) == BodyPart::arm;
        if (guides.from < 0 && !is_of_arm) {
            held.push_back(from_canonical);
            continue;
        }
        const Eigen::Quaterniond parent = held[static_cast<std::size_t>(joint.parent)];
        if (guides.from < 0) {
            held.push_back(parent);
            continue;
        }
        const Vector3<double> bone = shape.at(guides.to) - shape.at(guides.from);
        const Vector3<double> unturned = parent * axes[j] * Vector3<double>::UnitY();
        held.push_back((core::shortest_turn<double>(unturned, bone) * parent).normalized());
    }
    return held;
}

inline bool has_the_templates_names(const MotionClip& clip, const SkeletonTemplate& skeleton_template) {
    bool same = clip.joints.size() == skeleton_template.joints.size();
    for (std::size_t j = 0; same && j < clip.joints.size(); ++j)
        same = clip.joints[j].name == skeleton_template.joints[j].name;
    return same;
}

/// The direction in which the clip's body is upright: on average over all frames.
inline Vector3<double> mean_upwards(const MotionClip& clip, const ClipBody& body) {
    Vector3<double> sum = Vector3<double>::Zero();
    for (Eigen::Index frame = 0; frame < clip.frames.rows(); ++frame)
        sum += ClipShape(body, pose_in(clip, static_cast<std::size_t>(frame))).upwards().stableNormalized();
    return sum;
}

inline ClipReference clip_reference(const MotionClip& clip, const ClipBody& body,
                                    const SkeletonTemplate& skeleton_template) {
    ClipReference out;
    out.pose = rest_pose(clip);
    const ClipShape at_rest(body, out.pose);
    if (!at_rest.shows_body()) { // bones folded into a line, say: the motion alone says what they are
        if (clip.frames.rows() > 0) out.pose = pose_in(clip, 0);
        out.to_canonical =
            core::shortest_turn<double>(nearest_axis(mean_upwards(clip, body)), Vector3<double>::UnitY());
        out.held = bone_orientations(ClipShape(body, out.pose).as_template(clip, skeleton_template), skeleton_template);
        return out;
    }
    const Vector3<double> up = nearest_axis(at_rest.upwards());
    const Vector3<double> left = nearest_axis(at_rest.to_left() - at_rest.to_left().dot(up) * up);
    out.to_canonical = rotation_to_canonical(left, up);
    if (at_rest.stands_symmetric(up) && !has_the_templates_names(clip, skeleton_template))
        out.held = held_at_rest(body, at_rest, skeleton_template, out.to_canonical.conjugate());
    else
        out.held = bone_orientations(at_rest.as_template(clip, skeleton_template), skeleton_template);
    return out;
}

/// Holds the template's joints as a clip's body holds itself.
class ClipFollower {
public:
    ClipFollower(const ClipBody& body, const ClipReference& reference, const SkeletonTemplate& skeleton_template)
        : body_(&body), to_canonical_(reference.to_canonical), axes_(rest_axes<double>(skeleton_template)) {
        for (std::size_t j = 0; j < axes_.size(); ++j) {
            guides_.push_back(guides_of(body, skeleton_template.joints[j]));
            held_.push_back(mean_turn(reference.pose, guides_[j].turned_by).conjugate() * reference.held[j]);
        }
    }

    /// As `RigJoint::orientation`.
    [[nodiscard]] Orientations<double> orientations_in(const ClipPose& pose) const {
        const ClipShape shape(*body_, pose);
        Orientations<double> out;
        for (std::size_t j = 0; j < axes_.size(); ++j) {
            const ClipGuides& guides = guides_[j];
            Eigen::Quaterniond turn = to_canonical_ * mean_turn(pose, guides.turned_by) * held_[j];
            if (guides.from >= 0) {
                const Vector3<double> bone = to_canonical_ * (shape.at(guides.to) - shape.at(guides.from));
                turn = core::shortest_turn<double>(turn * axes_[j] * Vector3<double>::UnitY(), bone) * turn;
            }
            out.push_back(turn.normalized());
        }
        return out;
    }

    [[nodiscard]] Vector3<double> between_hips(const ClipPose& pose) const {
        return to_canonical_ * ClipShape(*body_, pose).between_hips();
    }

private:
    const ClipBody* body_;
    Eigen::Quaterniond to_canonical_;
    Orientations<double> axes_, held_;
    std::vector<ClipGuides> guides_;
};

/// A rig's hips and legs at rest.
struct RigHips {
    Vector3<double> to_root = Vector3<double>::Zero(); ///< from between the hip joints
    double leg_length = 0;                             ///< thigh and calf, mean of both sides
};

template <typename Scalar>
RigHips hips_of(const Rig<Scalar>& rig, const SkeletonTemplate& skeleton_template) {
    const auto place = [&](JointRole role, Side side) -> Vector3<double> {
        const int j = find_joint(skeleton_template, role, side);
        return rig.joints[static_cast<std::size_t>(j)].position.template cast<double>();
    };
    RigHips out;
    out.to_root = rig.joints.front().position.template cast<double>();
    for (const Side side : {Side::left, Side::right}) {
        const Vector3<double> hip = place(JointRole::hip, side), knee = place(JointRole::knee, side);
        const int ankle = find_joint(skeleton_template, JointRole::ankle, side);
        const Vector3<double> end = place(ankle >= 0 ? JointRole::ankle : JointRole::foot, side);
        out.to_root -= hip / 2;
        out.leg_length += ((knee - hip).norm() + (end - knee).norm()) / 2;
    }
    return out;
}

template <typename Scalar>
void require_joints_of(const SkeletonTemplate& skeleton_template, const Rig<Scalar>& rig) {
    bool same = rig.joints.size() == skeleton_template.joints.size();
    for (std::size_t j = 0; same && j < rig.joints.size(); ++j)
        same = rig.joints[j].role == skeleton_template.joints[j].role &&
               rig.joints[j].side == skeleton_template.joints[j].side &&
               rig.joints[j].parent == skeleton_template.joints[j].parent;
    if (!same)
        throw Error(ErrorCode::usage, "the rig's joints are not those of the template " + skeleton_template.name);
}

/// As far from the origin as a rig may move: half of what single precision holds, as files of characters have it.
inline constexpr double farthest_place = std::numeric_limits<float>::max() / 2.0;

/// What is wrong with the body of a clip as it is held in the reference; empty where nothing is.
inline std::string fault_of_shape(const ClipShape& shape) {
    if (!(shape.leg_length() > 0)) return "the clip's skeleton has legs without length; export it with its offsets";
    const Vector3<double> forward = shape.to_left().stableNormalized().cross(shape.along_trunk().stableNormalized());
    if (shape.along_feet().dot(forward) < -0.5)
        return "the feet of the clip's skeleton point backwards: its left and right are exchanged, or it is mirrored; "
               "export it in right-handed coordinates";
    return "";
}

} // namespace detail

template <typename Scalar>
Outcome<Animation<Scalar>> retarget(const MotionClip& clip, const Rig<Scalar>& rig,
                                    const SkeletonTemplate& skeleton_template) {
    detail::require_joints_of(skeleton_template, rig);
    const Outcome<ClipBody> body = find_body(clip);
    if (!body) return body.failure();
    const detail::ClipReference reference = detail::clip_reference(clip, *body, skeleton_template);
    const detail::ClipShape shape(*body, reference.pose);
    if (const std::string fault = detail::fault_of_shape(shape); !fault.empty()) return Failure{Refusal::none, fault};

    const detail::ClipFollower follower(*body, reference, skeleton_template);
    const detail::RigHips hips = detail::hips_of(rig, skeleton_template);
    const double scale = hips.leg_length / shape.leg_length();
    std::vector<Eigen::Quaterniond> back; // per joint, from how it is turned at rest to the template's rest pose
    for (const RigJoint<Scalar>& joint : rig.joints)
        back.push_back(joint.orientation.template cast<double>().conjugate());
    Animation<Scalar> out;
    out.seconds_per_frame = clip.seconds_per_frame;
    for (Eigen::Index frame = 0; frame < clip.frames.rows(); ++frame) {
        const ClipPose pose = pose_in(clip, static_cast<std::size_t>(frame));
        RigPose<Scalar> held;
        const Orientations<double> orientations = follower.orientations_in(pose);
        for (std::size_t j = 0; j < back.size(); ++j)
            held.axes.push_back((orientations[j] * back[j]).normalized().template cast<Scalar>() * rig.joints[j].axes);
        const Vector3<double> root =
            scale * follower.between_hips(pose) + orientations.front() * back.front() * hips.to_root;
        if (!(root.cwiseAbs().array() <= detail::farthest_place).all())
            return Failure{Refusal::none, "the clip's skeleton is moved too far to compute with in frame " +
                                              std::to_string(frame) + "; export it with its own offsets"};
        held.root = root.cast<Scalar>();
        out.frames.push_back(std::move(held));
    }
    if (out.frames.empty()) return out;
    const Vector3<Scalar> start(out.frames.front().root[0], 0, out.frames.front().root[2]);
    for (RigPose<Scalar>& held : out.frames) held.root -= start;
    return on_floor(rig, std::move(out));
}

} // namespace skelgen::applications
