#pragma once

// human21 in poses, by forward kinematics: what the refinement hands to the sides.

#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/refine.hpp>

namespace skelgen::test {

/// Degrees. Legs: `bend` swings the thigh forwards and the calf backwards and lifts the toes, `side` away from the
/// body, `turn` the toes outwards. Arms: `bend` forwards, `side` up from level. Trunk: `bend` forwards, `turn` to the
/// left.
struct Angles {
    double bend = 0, side = 0, turn = 0;
};

/// A way to hold oneself; joints that are not named are as in the template's rest pose (a T).
struct TestPose {
    std::string name;
    std::map<std::string, Angles> joints;
};

/// Joints as the refinement finds them and the frame that they should lead to.
struct PosedBody {
    refinement::RefinedJoints<double> joints;
    BodyFrame<double> frame;
};

namespace detail {

inline Eigen::Matrix3d joint_rotation(const TemplateJoint& joint, const Angles& angles) {
    const double degrees = std::numbers::pi / 180, outwards = joint.side == Side::right ? -1 : 1;
    const auto about = [&](double angle, const Vector3<double>& axis) {
        return Eigen::AngleAxisd(degrees * angle, axis).toRotationMatrix();
    };
    const Vector3<double> right = -Vector3<double>::UnitX(), forward = Vector3<double>::UnitZ(),
                          up = Vector3<double>::UnitY();
    switch (joint.role) {
    case JointRole::shoulder:
    case JointRole::elbow:
    case JointRole::wrist:
    case JointRole::hand:
        return about(-outwards * angles.bend, up) * about(outwards * angles.side, forward);
    case JointRole::hip:
    case JointRole::ankle:
    case JointRole::foot:
        return about(angles.bend, right) * about(outwards * angles.side, forward) * about(outwards * angles.turn, up);
    case JointRole::knee:
        return about(-angles.bend, right);
    default:
        return about(-angles.bend, right) * about(angles.turn, up);
    }
}

} // namespace detail

/// human21 in `pose`, turned as a whole by `rotation`.
inline PosedBody posed(const TestPose& pose, const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity()) {
    const SkeletonTemplate& human = builtin_template("human21");
    PosedBody out;
    const auto n = static_cast<Eigen::Index>(human.joints.size());
    out.joints.positions.resize(n, 3);
    std::vector<Eigen::Matrix3d> turned;
    for (std::size_t j = 0; j < human.joints.size(); ++j) {
        const TemplateJoint& joint = human.joints[j];
        const auto row = static_cast<Eigen::Index>(j);
        const auto given = pose.joints.find(joint.name);
        const Eigen::Matrix3d own =
            detail::joint_rotation(joint, given == pose.joints.end() ? Angles{} : given->second);
        if (joint.parent < 0) {
            turned.push_back(rotation * own);
            out.joints.positions.row(row) = joint.position.transpose();
        } else {
            const auto parent = static_cast<std::size_t>(joint.parent);
            const Vector3<double> bone = joint.position - human.joints[parent].position;
            out.joints.positions.row(row) =
                out.joints.positions.row(joint.parent) + (turned[parent] * bone).transpose();
            turned.push_back(turned[parent] * own);
        }
        if (!joint.tip) continue;
        const Vector3<double> to_tip = *joint.tip - joint.position;
        out.joints.tips.emplace_back(static_cast<int>(j),
                                     out.joints.positions.row(row).transpose() + turned.back() * to_tip);
    }
    out.frame.origin = out.joints.positions.row(0).transpose();
    out.frame.left = turned[0].col(0);
    out.frame.up = turned[0].col(1);
    out.frame.forward = turned[0].col(2);
    return out;
}

/// `angles` at the joint of both sides.
inline void both(TestPose& pose, const std::string& joint, const Angles& angles) {
    pose.joints["left_" + joint] = pose.joints["right_" + joint] = angles;
}

/// Twenty ways to hold oneself.
inline std::vector<TestPose> test_poses() {
    std::vector<TestPose> list{{"rest", {}}};
    const auto add = [&](const std::string& name, const std::map<std::string, Angles>& joints,
                         const std::map<std::string, Angles>& on_both_sides = {}) {
        list.push_back({name, joints});
        for (const auto& [joint, angles] : on_both_sides) both(list.back(), joint, angles);
    };
    add("arms hanging", {}, {{"shoulder", {0, -80, 0}}, {"elbow", {10, 0, 0}}});
    add("walking",
        {{"left_hip", {30, 0, 5}}, {"left_knee", {10, 0, 0}}, {"right_hip", {-20, 0, 5}}, {"right_knee", {30, 0, 0}}},
        {{"shoulder", {0, -75, 0}}});
    add("running",
        {{"left_hip", {65, 0, 0}}, {"left_knee", {90, 0, 0}}, {"right_hip", {-15, 0, 0}}, {"right_knee", {60, 0, 0}}},
        {{"shoulder", {0, -70, 0}}, {"elbow", {90, 0, 0}}});
    add("sitting", {}, {{"hip", {88, 5, 5}}, {"knee", {90, 0, 0}}});
    add("sitting with straight legs", {}, {{"hip", {90, 10, 10}}});
    add("kneeling", {}, {{"knee", {95, 0, 0}}, {"ankle", {-40, 0, 0}}});
    add("kneeling on one knee", {{"left_hip", {85, 0, 0}},
                                 {"left_knee", {85, 0, 0}},
                                 {"right_knee", {95, 0, 0}},
                                 {"right_ankle", {-20, 0, 0}}});
    add("one leg up", {{"right_hip", {100, 0, 0}}, {"right_knee", {100, 0, 0}}});
    add("straight leg up", {{"left_hip", {85, 0, 0}}});
    add("leg up to the side", {{"left_hip", {0, 70, 0}}});
    add("straddling", {}, {{"hip", {0, 40, 15}}});
    add("hips turned out", {}, {{"hip", {0, 8, 45}}});
    add("toes turned in", {}, {{"hip", {0, 5, -20}}});
    add("squatting", {}, {{"hip", {105, 20, 20}}, {"knee", {120, 0, 0}}, {"ankle", {20, 0, 0}}});
    add("lunging", {{"left_hip", {80, 0, 0}}, {"left_knee", {80, 0, 0}}, {"right_hip", {-30, 0, 10}}});
    add("on tiptoe", {}, {{"ankle", {-35, 0, 0}}});
    add("kicking backwards", {{"right_hip", {-25, 0, 0}}, {"right_knee", {110, 0, 0}}});
    add("bowing, turned", {{"waist", {40, 0, 15}}, {"chest", {25, 0, 15}}}, {{"shoulder", {20, -20, 0}}});
    add("handstand", {}, {{"shoulder", {0, 85, 0}}, {"hip", {5, 5, 0}}});
    return list;
}

/// Whole-body rotations: as standing, lying face down, on the back and on the side, upside down, and any.
inline std::vector<Eigen::Matrix3d> test_orientations() {
    const auto about = [](double angle, const Vector3<double>& axis) {
        return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    };
    const double quarter = std::numbers::pi / 2;
    return {Eigen::Matrix3d::Identity(),
            about(quarter, Vector3<double>::UnitX()),
            about(-quarter, Vector3<double>::UnitX()),
            about(quarter, Vector3<double>::UnitZ()),
            about(2 * quarter, Vector3<double>::UnitX()),
            about(2.1, {1, 2, 3}),
            about(-1.3, {3, -2, 0.5})};
}

/// The same joints in another precision.
template <typename Scalar>
refinement::RefinedJoints<Scalar> in_precision(const refinement::RefinedJoints<double>& joints) {
    refinement::RefinedJoints<Scalar> out;
    out.positions = joints.positions.template cast<Scalar>();
    for (const auto& [joint, tip] : joints.tips) out.tips.emplace_back(joint, tip.template cast<Scalar>());
    return out;
}

} // namespace skelgen::test
