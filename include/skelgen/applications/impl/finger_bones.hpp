#pragma once

#include <skelgen/applications/finger_bones.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/surface/face_tree.hpp>

namespace skelgen::applications {
namespace detail {

/// From 0 at -1 to 1 at 1, level at both ends.
template <typename Scalar>
Scalar smooth_step(Scalar x) {
    const Scalar t = std::clamp((x + 1) / 2, Scalar(0), Scalar(1));
    return t * t * (3 - 2 * t);
}

/// A digit's bones, along which places have coordinates.
template <typename Scalar>
class DigitBones {
public:
    DigitBones(const hands::FoundDigit<Scalar>& digit, hands::DigitKind kind)
        : places_{digit.joints[0], digit.joints[1], digit.joints[2], digit.tip}, count_(hands::joints_of(kind)) {
        constexpr Scalar narrow = Scalar(0.7);
        for (std::size_t k = 0; k < count_; ++k) {
            begins_[k + 1] = begins_[k] + (places_[k + 1] - places_[k]).norm();
            // The narrower a bend, the less volume it loses, and the more edges stretch. That at the knuckle ends at
            // the web.
            widths_[k] = narrow * digit.radii[k];
        }
        thickness_ = std::max(digit.radii[1], digit.radii[2]);
        if (digit.digit != hands::Digit::thumb || kind == hands::DigitKind::toe)
            widths_[0] = std::clamp((digit.web - digit.joints[0]).norm(), digit.radii[0] / 2, 2 * digit.radii[0]);
    }

    /// How far a place is from the bones, and where beside them, from the first joint on, before it negative.
    struct Beside {
        Scalar distance = std::numeric_limits<Scalar>::infinity();
        Scalar along = 0;
    };
    [[nodiscard]] Beside beside(const Vector3<Scalar>& place) const {
        Beside out;
        for (std::size_t k = 0; k < count_; ++k) {
            const Vector3<Scalar> bone = places_[k + 1] - places_[k];
            const Scalar length = bone.norm();
            if (!(length > 0)) continue;
            const auto near = core::nearest_on_segment<Scalar, 3>(place, places_[k], places_[k + 1]);
            if (!(near.distance < out.distance)) continue;
            out.distance = near.distance;
            out.along = begins_[k] + near.along * length;
            if (k == 0 && near.along == 0) out.along = (place - places_[0]).dot(bone) / length;
        }
        return out;
    }

    /// How much what is there follows each bone; what is left follows the wrist.
    [[nodiscard]] std::array<Scalar, hands::phalanges> shares(Scalar along) const {
        std::array<Scalar, hands::phalanges> out{};
        Scalar beyond = 1;
        for (std::size_t k = 0; k < count_; ++k) {
            const Scalar width = widths_[k] > 0 ? widths_[k] : (begins_[k + 1] - begins_[k]) / 4;
            const Scalar part = width > 0 ? smooth_step<Scalar>((along - begins_[k]) / width) : Scalar(along > 0);
            const Scalar here = beyond * part;
            if (k > 0) out[k - 1] -= here;
            out[k] = here;
            beyond = here;
        }
        return out;
    }

    [[nodiscard]] Scalar thickness() const { return thickness_; }

private:
    std::array<Vector3<Scalar>, hands::phalanges + 1> places_; ///< a toe has its tip twice
    std::size_t count_;                                        ///< of bones
    std::array<Scalar, hands::phalanges + 1> begins_{};
    std::array<Scalar, hands::phalanges> widths_{};
    Scalar thickness_ = 0;
};

/// The digits of a hand, and which of them a place is on.
template <typename Scalar>
class DigitsOfHand {
public:
    explicit DigitsOfHand(const hands::Hand<Scalar>& hand)
        : surface_(hand.surface), tree_(hand.surface),
          digit_(static_cast<std::size_t>(hand.surface.vertices.rows()), -1) {
        for (const hands::FoundDigit<Scalar>& digit : hand.digits) {
            for (const int v : digit.vertices) digit_[static_cast<std::size_t>(v)] = static_cast<int>(bones_.size());
            bones_.emplace_back(digit, hand.kind);
        }
    }

    /// Which digit moves a place on the surface, and by how much each of its bones.
    struct Following {
        int digit = -1;
        std::array<Scalar, hands::phalanges> shares{};
    };
    [[nodiscard]] Following following(const Vector3<Scalar>& place) const {
        const int corner = tree_.nearest_corner(surface_, place);
        const int on = corner < 0 ? -1 : digit_[static_cast<std::size_t>(corner)];
        if (on >= 0) return {on, bones(on).shares(bones(on).beside(place).along)};
        Following out;
        Scalar least = std::numeric_limits<Scalar>::infinity();
        typename DigitBones<Scalar>::Beside nearest;
        for (int d = 0; d < static_cast<int>(bones_.size()); ++d) {
            const auto beside = bones(d).beside(place);
            if (!(beside.distance < least)) continue;
            least = beside.distance;
            nearest = beside;
            out.digit = d;
        }
        if (out.digit < 0) return out;
        // A palm follows what lies in it, the less the farther it is.
        constexpr Scalar all = Scalar(1.2), none = Scalar(2.6); // in thicknesses
        const Scalar middle = (all + none) / 2, half = (none - all) / 2;
        const Scalar near = 1 - smooth_step<Scalar>((nearest.distance / bones(out.digit).thickness() - middle) / half);
        out.shares = bones(out.digit).shares(nearest.along);
        for (Scalar& share : out.shares) share *= near;
        return out;
    }

private:
    [[nodiscard]] const DigitBones<Scalar>& bones(int d) const { return bones_[static_cast<std::size_t>(d)]; }

    const TriangleMesh<Scalar>& surface_;
    surface::FaceTree<Scalar> tree_;
    std::vector<int> digit_; ///< per vertex of the surface, -1 in the palm
    std::vector<DigitBones<Scalar>> bones_;
};

/// Divides what a vertex gives to wrist and hand.
template <typename Scalar>
Skin<Scalar> with_divided_hand(Skin<Scalar> skin, const TriangleMesh<Scalar>& mesh, const hands::Hand<Scalar>& hand,
                               int wrist, int middle, int first_bone) {
    const DigitsOfHand<Scalar> digits(hand);
    const std::size_t bones = hands::joints_of(hand.kind);
    constexpr int influences = Skin<Scalar>::influences;
    for (Eigen::Index v = 0; v < skin.joints.rows(); ++v) {
        Scalar freed = 0;
        std::vector<std::pair<Scalar, int>> all;
        for (int k = 0; k < influences; ++k) {
            const Scalar weight = skin.weights(v, k);
            if (!(weight > 0)) continue;
            if (skin.joints(v, k) == wrist || skin.joints(v, k) == middle)
                freed += weight;
            else
                all.emplace_back(weight, skin.joints(v, k));
        }
        if (!(freed > 0)) continue;
        const auto follows = digits.following(core::point(mesh.vertices, v));
        Scalar left = 1;
        for (std::size_t k = 0; k < bones && follows.digit >= 0; ++k) {
            const Scalar share = std::max(follows.shares[k], Scalar(0));
            left -= share;
            if (share > 0)
                all.emplace_back(freed * share,
                                 first_bone + follows.digit * static_cast<int>(bones) + static_cast<int>(k));
        }
        if (left > 0) all.emplace_back(freed * left, wrist);
        std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first > b.first : a.second < b.second;
        });
        if (all.size() > influences) all.resize(influences);
        Scalar sum = 0;
        constexpr Scalar least = std::numeric_limits<float>::epsilon(); // of the strongest: files hold floats
        std::erase_if(all, [&](const auto& each) { return each.first <= least * all.front().first; });
        for (const auto& [weight, joint] : all) sum += weight;
        for (int k = 0; k < influences; ++k) {
            const bool is_used = k < static_cast<int>(all.size());
            skin.weights(v, k) = is_used ? all[static_cast<std::size_t>(k)].first / sum : Scalar(0);
            skin.joints(v, k) = is_used ? all[static_cast<std::size_t>(k)].second : 0;
        }
    }
    return skin;
}

/// From the input's pose, scaled, to the rest pose.
template <typename Scalar>
struct FingerToRest {
    Scalar scale = 1;
    RigidMotion<Scalar> motion = {};

    [[nodiscard]] Vector3<Scalar> operator()(const Vector3<Scalar>& place) const { return motion(scale * place); }
};

/// How the vertices that follow a digit most were brought to rest: its bones go with them. As `otherwise` where they
/// are too few to say.
template <typename Scalar>
FingerToRest<Scalar> motion_of_digit(const Rig<Scalar>& rig, const TriangleMesh<Scalar>& mesh, int first_bone,
                                     std::size_t bones, const FingerToRest<Scalar>& otherwise) {
    constexpr std::size_t least = 12; // vertices
    std::vector<Eigen::Index> vertices;
    for (Eigen::Index v = 0; v < rig.skin.joints.rows(); ++v)
        if (const int bone = rig.skin.joints(v, 0) - first_bone; bone >= 0 && bone < static_cast<int>(bones))
            vertices.push_back(v);
    if (vertices.size() < least) return otherwise;
    Eigen::Matrix<Scalar, 3, Eigen::Dynamic> from(3, static_cast<Eigen::Index>(vertices.size())), to = from;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        from.col(static_cast<Eigen::Index>(i)) = rig.metres_per_unit * core::point(mesh.vertices, vertices[i]);
        to.col(static_cast<Eigen::Index>(i)) = core::point(rig.mesh.vertices, vertices[i]);
    }
    const Eigen::Matrix<Scalar, 4, 4> fitted = Eigen::umeyama(from, to, false);
    const Eigen::Matrix<Scalar, 3, 3> turn = fitted.template topLeftCorner<3, 3>();
    return {rig.metres_per_unit,
            {Eigen::Quaternion<Scalar>(turn).normalized(), fitted.template topRightCorner<3, 1>()}};
}

/// Axes of a digit's bone: y along it, x its hinge.
template <typename Scalar>
Eigen::Quaternion<Scalar> digit_axes(const Vector3<Scalar>& bone, const Vector3<Scalar>& hinge) {
    const bool is_hinge = bone.cross(hinge).norm() > core::rounding<Scalar>() * bone.norm();
    return axes_along<Scalar>(bone, is_hinge ? hinge : Vector3<Scalar>(bone.unitOrthogonal()));
}

} // namespace detail

template <typename Scalar>
Rig<Scalar> with_finger_bones(Rig<Scalar> rig, const TriangleMesh<Scalar>& mesh,
                              const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                              const std::vector<hands::Hand<Scalar>>& hands) {
    if (rig.joints.size() != skeleton.joints.size() || rig.motions.size() != skeleton.joints.size())
        throw Error(ErrorCode::usage, "the rig was not made of that skeleton: it has other joints");
    for (const hands::Hand<Scalar>& hand : hands) {
        const bool is_foot = hand.kind == hands::DigitKind::toe;
        const std::size_t bones = hands::joints_of(hand.kind);
        const int wrist = find_joint(skeleton_template, is_foot ? JointRole::foot : JointRole::wrist, hand.side);
        const int middle = is_foot ? wrist : find_joint(skeleton_template, JointRole::hand, hand.side);
        if (hand.digits.empty() || wrist < 0 || middle < 0) continue;
        rig.skin = detail::with_divided_hand(std::move(rig.skin), mesh, hand, wrist, middle,
                                             static_cast<int>(rig.joints.size()));
        for (const hands::FoundDigit<Scalar>& digit : hand.digits) {
            // Else the thumb is at rest as the wrist has it, the fingers as the knuckles.
            const auto carrier = static_cast<std::size_t>(digit.digit == hands::Digit::thumb ? wrist : middle);
            const RigJoint<Scalar> carried_by = rig.joints[carrier];
            const detail::FingerToRest<Scalar> carried{rig.metres_per_unit, rig.motions[carrier]};
            const auto at_rest =
                detail::motion_of_digit(rig, mesh, static_cast<int>(rig.joints.size()), bones, carried);
            for (std::size_t k = 0; k < bones; ++k) {
                const Vector3<Scalar> end = k + 1 < bones ? digit.joints[k + 1] : digit.tip;
                RigJoint<Scalar> joint;
                joint.name = hands::joint_name(hand.side, digit.digit, k + 1, hand.kind);
                joint.parent = k == 0 ? wrist : static_cast<int>(rig.joints.size()) - 1;
                joint.role = is_foot ? JointRole::foot : JointRole::hand;
                joint.side = hand.side;
                joint.position = at_rest(digit.joints[k]);
                joint.end = at_rest(end);
                joint.axes =
                    detail::digit_axes<Scalar>(joint.end - joint.position, at_rest.motion.rotation * digit.hinge);
                joint.confidence = digit.confidence;
                joint.orientation = carried_by.orientation;
                rig.joints.push_back(std::move(joint));
            }
        }
    }
    return rig;
}

template <typename Scalar>
Rig<Scalar> without_finger_bones(Rig<Scalar> rig, std::size_t own) {
    for (int& joint : rig.skin.joints.reshaped())
        while (joint >= static_cast<int>(own)) joint = rig.joints[static_cast<std::size_t>(joint)].parent;
    rig.joints.resize(std::min(rig.joints.size(), own));
    return rig;
}

template <typename Scalar>
Animation<Scalar> with_held_fingers(Animation<Scalar> animation, const Rig<Scalar>& rig) {
    for (RigPose<Scalar>& frame : animation.frames)
        for (std::size_t j = frame.axes.size(); j < rig.joints.size(); ++j) {
            const auto parent = static_cast<std::size_t>(rig.joints[j].parent);
            frame.axes.push_back(frame.axes[parent] * rig.joints[parent].axes.conjugate() * rig.joints[j].axes);
        }
    return animation;
}

} // namespace skelgen::applications
