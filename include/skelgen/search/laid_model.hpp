#pragma once

// What bodies that are laid into a surface are made of, at rest (rest_fit.hpp) and in any pose (posed_fit.hpp).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <nanoflann.hpp>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/least_squares.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::search::detail {

using Vec3d = Vector3<double>;

/// What a body has to enclose at least, for unit area: a person has 0.05, a sheet nothing.
template <typename Scalar>
inline constexpr Scalar least_volume = Scalar(1e-3);

using Places = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// So many places spread evenly over a surface, in order of its faces: the same for the same mesh.
/// `faces`: gets the face of each.
template <typename Scalar>
Places spread_places(const TriangleMesh<Scalar>& mesh, int count, std::vector<Eigen::Index>* faces = nullptr) {
    std::vector<double> sum(static_cast<std::size_t>(mesh.faces.rows()));
    double area = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        sum[static_cast<std::size_t>(f)] = area += static_cast<double>(core::face_area_vector(mesh, f).norm()) / 2;
    Places out(count, 3);
    // Within a face places follow the golden ratio's low-discrepancy sequence.
    constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532;
    for (int i = 0; i < count; ++i) {
        const double at = area * (i + 0.5) / count;
        const auto f =
            std::min<Eigen::Index>(std::lower_bound(sum.begin(), sum.end(), at) - sum.begin(), mesh.faces.rows() - 1);
        if (faces) faces->push_back(f);
        double u = std::fmod(step_u * (i + 1), 1.0), v = std::fmod(step_v * (i + 1), 1.0);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        const auto corner = [&](int k) -> Vec3d {
            return core::point(mesh.vertices, mesh.faces(f, k)).template cast<double>();
        };
        out.row(i) = (corner(0) + u * (corner(1) - corner(0)) + v * (corner(2) - corner(0))).transpose();
    }
    return out;
}

/// Places in a tree.
class PlaceTree {
public:
    explicit PlaceTree(const Places& places) : places_(places), tree_(3, places_) {}

    [[nodiscard]] std::pair<Eigen::Index, double> nearest(const Vec3d& place) const {
        Eigen::Index index = 0;
        double squared = std::numeric_limits<double>::infinity();
        nanoflann::KNNResultSet<double, Eigen::Index> result(1);
        result.init(&index, &squared);
        tree_.index->findNeighbors(result, place.data(), nanoflann::SearchParams());
        return {index, std::sqrt(squared)};
    }

private:
    const Places& places_;
    nanoflann::KDTreeEigenMatrixAdaptor<Places, 3, nanoflann::metric_L2_Simple> tree_;
};

/// What is laid into the surface: 23 numbers in units of the height, x across the mirror plane, y up, z forward or
/// back, the feet's lowest place at y = 0 and the highest at 1.
enum Number {
    floor_y,
    crotch_y,
    neck_y,
    top_y,
    shoulder_x,
    shoulder_drop,
    arm_angle,
    arm_length,
    hip_x,
    ankle_x,
    crotch_z,
    neck_z,
    hand_z,
    ankle_z,
    head_z,
    head_radius,
    trunk_radius,
    chest_radius,
    shoulder_radius,
    wrist_radius,
    thigh_radius,
    ankle_radius,
    foot_length,
    numbers
};

using RestNumbers = Eigen::Matrix<double, numbers, 1>;

/// Proportions that a fit starts from.
struct RestStart {
    double crotch, neck, shoulder, drop, arm, hip, head_radius, trunk_radius, arm_radius, leg_radius;
};

/// An adult; a child or a figure of four heads; one of two heads. Parts of the height.
inline constexpr std::array<RestStart, 3> rest_starts{{{.47, .83, .10, .02, .42, .05, .06, .07, .025, .045},
                                                       {.38, .70, .10, .03, .34, .055, .12, .09, .03, .05},
                                                       {.25, .53, .10, .03, .28, .06, .20, .11, .035, .05}}};
inline constexpr std::array<double, 3> arm_angles{0.1, 0.8, 1.3}; ///< below level: T-pose, A-pose, hanging

inline RestNumbers start_at(const RestStart& start, double angle) {
    RestNumbers out = RestNumbers::Zero();
    out[crotch_y] = start.crotch;
    out[neck_y] = start.neck;
    out[top_y] = 1;
    out[shoulder_x] = start.shoulder;
    out[shoulder_drop] = start.drop;
    out[arm_angle] = angle;
    out[arm_length] = start.arm;
    out[hip_x] = start.hip;
    out[ankle_x] = 1.2 * start.hip;
    out[head_radius] = std::log(start.head_radius);
    out[trunk_radius] = out[chest_radius] = std::log(start.trunk_radius);
    out[shoulder_radius] = out[wrist_radius] = std::log(start.arm_radius);
    out[thigh_radius] = std::log(1.2 * start.leg_radius);
    out[ankle_radius] = std::log(0.7 * start.leg_radius);
    return out;
}

/// A cone with round ends, widened to both sides.
struct ModelBone {
    Vec3d from, to;
    double from_radius, to_radius;
    Vec3d from_width = Vec3d::Zero(), to_width = Vec3d::Zero(); ///< to one side; none: both zero
    bool has_middle = true;                                     ///< that its axis has to be in; feet have none
};

/// The model's half beside the mirror plane.
struct RestModel {
    std::array<ModelBone, 5> bones; ///< head, trunk, arm, leg, foot
    Vec3d top, neck, crotch, shoulder, fingertip, hip, ankle, toe;
};

inline RestModel model_of(const RestNumbers& n) {
    const double head = std::exp(n[head_radius]), trunk = std::exp(n[trunk_radius]), chest = std::exp(n[chest_radius]);
    const double upper_arm = std::exp(n[shoulder_radius]), wrist = std::exp(n[wrist_radius]);
    const double thigh = std::exp(n[thigh_radius]), shin = std::exp(n[ankle_radius]);
    RestModel out;
    out.neck = {0, n[neck_y], n[neck_z]};
    out.top = {0, n[top_y], n[head_z]};
    out.crotch = {0, n[crotch_y] + 0.5 * trunk, n[crotch_z]};
    out.shoulder = {n[shoulder_x], n[neck_y] - n[shoulder_drop], n[neck_z]};
    out.fingertip = out.shoulder + Vec3d(n[arm_length] * std::cos(n[arm_angle]),
                                         -n[arm_length] * std::sin(n[arm_angle]), n[hand_z] - n[neck_z]);
    out.hip = {n[hip_x], n[crotch_y] + 0.3 * trunk, n[crotch_z]};
    out.ankle = {n[ankle_x], n[floor_y] + shin, n[ankle_z]};
    out.toe = out.ankle + Vec3d(0, 0, n[foot_length]);
    const Vec3d skull(0, n[top_y] - head, n[head_z]);
    const Vec3d chin(0, std::min(n[neck_y] + head, skull.y()), n[head_z]);
    out.bones = {
        {{chin, skull, head, head},
         {out.crotch, out.neck, trunk, chest, n[hip_x] * Vec3d::UnitX(), 0.8 * n[shoulder_x] * Vec3d::UnitX()},
         {out.shoulder, out.fingertip, upper_arm, wrist},
         {out.hip, out.ankle, thigh, shin},
         {.from = out.ankle, .to = out.toe, .from_radius = 0.8 * shin, .to_radius = 0.8 * shin, .has_middle = false}}};
    return out;
}

/// A bone's numbers in a column: both ends, both radii, both widths.
inline constexpr int bone_numbers = 14;
using BoneNumbers = Eigen::Matrix<double, bone_numbers, 1>;

template <std::size_t count>
inline constexpr int numbers_of_all = bone_numbers* static_cast<int>(count);
template <std::size_t count>
using BonesNumbers = Eigen::Matrix<double, numbers_of_all<count>, 1>;

template <std::size_t count>
BonesNumbers<count> numbers_of(const std::array<ModelBone, count>& bones) {
    BonesNumbers<count> out;
    for (std::size_t b = 0; b < count; ++b) {
        auto of_bone = out.template segment<bone_numbers>(bone_numbers * static_cast<Eigen::Index>(b));
        of_bone << bones[b].from, bones[b].to, bones[b].from_radius, bones[b].to_radius, bones[b].from_width,
            bones[b].to_width;
    }
    return out;
}

/// How far a place is outside a bone; negative within it. `by_bone`: gets the derivatives by the bone's numbers.
/// `outwards`: the unit direction from the bone's axis to the place.
inline double beyond(const ModelBone& bone, const Vec3d& place, BoneNumbers* by_bone = nullptr,
                     Vec3d* outwards = nullptr) {
    const Vec3d along = bone.to - bone.from, off = place - bone.from;
    const double squared = along.squaredNorm() + 1e-12;
    const double anywhere = off.dot(along) / squared, u = std::clamp(anywhere, 0.0, 1.0);
    Vec3d across = off - u * along;
    double sideways = 0; // part of the width, to either side
    if (bone.from_width != Vec3d::Zero()) {
        const Vec3d wide = bone.from_width + u * (bone.to_width - bone.from_width);
        const double width = wide.norm();
        if (width > 0) sideways = std::clamp(wide.dot(across) / (width * width), -1.0, 1.0);
        across -= sideways * wide;
    }
    const double distance = across.norm();
    const Vec3d away = across / std::max(distance, 1e-12);
    if (outwards) *outwards = away;
    if (by_bone) {
        *by_bone << -(1 - u) * away, -u * away, -(1 - u), -u, -(1 - u) * sideways * away, -u * sideways * away;
        if (anywhere == u) { // the place on the axis moves along with its ends
            const double by_u =
                -away.dot(along + sideways * (bone.to_width - bone.from_width)) - (bone.to_radius - bone.from_radius);
            by_bone->head<3>() += by_u / squared * (2 * u * along - along - off);
            by_bone->segment<3>(3) += by_u / squared * (off - 2 * u * along);
        }
    }
    return distance - (bone.from_radius + u * (bone.to_radius - bone.from_radius));
}

/// Grows as the logarithm where a residual is large, so that what the body wears and holds counts no more than it is
/// there; and its derivative.
inline std::pair<double, double> robust(double residual) {
    const double squared = residual * residual, size = std::sqrt(std::log1p(squared));
    return {std::copysign(size, residual), size > 1e-9 ? std::abs(residual) / ((1 + squared) * size) : 1};
}

/// How deep a place is in a surface, negative outside, and the direction that leads deeper.
struct Depth {
    double depth = 0;
    Vec3d inwards = Vec3d::Zero(); ///< unit
};

/// Depths in a surface, by places spread over it, in units of `unit`.
class SurfaceDepth {
public:
    template <typename Scalar>
    SurfaceDepth(const TriangleMesh<Scalar>& mesh, double unit) : normals_(many, 3) {
        std::vector<Eigen::Index> faces;
        cloud_ = spread_places(mesh, many, &faces) / unit;
        for (int i = 0; i < many; ++i)
            normals_.row(i) = core::face_area_vector(mesh, faces[static_cast<std::size_t>(i)])
                                  .normalized()
                                  .template cast<double>()
                                  .transpose();
        tree_.emplace(cloud_);
    }
    SurfaceDepth(const SurfaceDepth&) = delete; // the tree knows where the cloud is
    SurfaceDepth& operator=(const SurfaceDepth&) = delete;

    [[nodiscard]] Depth operator()(const Vec3d& place) const {
        const auto [nearest, distance] = tree_->nearest(place);
        const Vec3d off = place - cloud_.row(nearest).transpose();
        const bool is_outside = off.dot(normals_.row(nearest).transpose()) > 0;
        const Vec3d away = off / std::max(distance, 1e-12);
        return is_outside ? Depth{-distance, -away} : Depth{distance, away};
    }

private:
    static constexpr int many = 20000;
    Places cloud_, normals_;
    std::optional<PlaceTree> tree_;
};

inline constexpr double prior_weight = 0.5; ///< beside the weights of add_misfit
inline constexpr double at_known = 0.005;   ///< of the height: how far from a known place counts 1

/// A place on a surface, and the surface's unit normal there, outwards; zero where it does not count.
struct SurfacePlace {
    Vec3d place, normal = Vec3d::Zero();
};

/// Adds the residuals of places that lie on no bone, and with middles those of axes that are not in the middle. A place
/// is of the bone that is nearest to it, where one whose surface faces the other way counts as farther.
/// `by_number`: derivatives of the bones' numbers by the model's. `depth_of`: the Depth of a place.
template <int numbers, std::size_t count, typename DepthOf>
void add_misfit(const std::array<ModelBone, count>& bones,
                const Eigen::Matrix<double, numbers_of_all<count>, numbers>& by_number,
                const std::vector<SurfacePlace>& places, bool with_middles, const DepthOf& depth_of,
                core::NormalEquations<numbers>& out) {
    constexpr double on_surface = 0.02, in_middle = 0.03;        // of the height: as much as counts 1
    constexpr double facing_away = 3 * on_surface;               // as much farther is a bone that faces the other way
    constexpr double surface_weight = 6, middle_weight = 4;      // of all residuals of the kind
    constexpr std::array<double, 4> along{0.1, 0.35, 0.65, 0.9}; // where axes have to be in the middle
    std::array<core::NormalEquations<bone_numbers>, count> of_bone;
    const auto add = [&](std::size_t bone, double off, double unit, double weight, const BoneNumbers& by_bone) {
        const auto [residual, slope] = robust(off / unit);
        of_bone[bone].add(Eigen::Matrix<double, 1, 1>(weight * residual), weight * slope / unit * by_bone.transpose());
    };
    BoneNumbers by_bone;
    for (const auto& [place, normal] : places) {
        std::size_t nearest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t b = 0; b < count; ++b) {
            Vec3d outwards;
            const double distance =
                std::abs(beyond(bones[b], place, nullptr, &outwards)) + facing_away * (1 - normal.dot(outwards)) / 2;
            if (distance < least) std::tie(least, nearest) = std::pair(distance, b);
        }
        const double off = beyond(bones[nearest], place, &by_bone);
        add(nearest, off, on_surface, surface_weight / std::sqrt(static_cast<double>(places.size())), by_bone);
    }
    const auto with_middle =
        std::count_if(bones.begin(), bones.end(), [](const ModelBone& bone) { return bone.has_middle; });
    const double weight =
        middle_weight / std::sqrt(static_cast<double>(with_middle) * static_cast<double>(along.size()));
    for (std::size_t b = 0; b < count && with_middles; ++b) {
        const ModelBone& bone = bones[b];
        if (!bone.has_middle) continue;
        for (const double part : along) {
            const auto [depth, inwards] = depth_of(bone.from + part * (bone.to - bone.from));
            by_bone << (1 - part) * inwards, part * inwards, part - 1, -part, Vec3d::Zero(), Vec3d::Zero();
            const double radius = bone.from_radius + part * (bone.to_radius - bone.from_radius);
            add(b, depth - radius, in_middle, weight, by_bone);
        }
    }
    // A bone goes by few of the model's numbers.
    for (std::size_t b = 0; b < count; ++b) {
        const auto by_all = by_number.template middleRows<bone_numbers>(bone_numbers * static_cast<Eigen::Index>(b));
        std::vector<std::pair<Eigen::Index, BoneNumbers>> moving;
        for (Eigen::Index n = 0; n < numbers; ++n)
            if (!by_all.col(n).isZero(0)) moving.emplace_back(n, by_all.col(n));
        for (const auto& [n, by_n] : moving) {
            const BoneNumbers squares = of_bone[b].square * by_n;
            for (const auto& [m, by_m] : moving) out.square(m, n) += by_m.dot(squares);
            out.gradient[n] += by_n.dot(of_bone[b].gradient);
        }
        out.cost += of_bone[b].cost;
    }
}

/// The way from the model's coordinates to the body's.
struct RestFrame {
    Vec3d across, up, ahead; ///< unit
    double offset = 0, floor = 0, height = 1, depth = 0;

    [[nodiscard]] Vec3d to_body(const Vec3d& place, double side) const {
        return across * (offset + side * height * place.x()) + up * (floor + height * place.y()) +
               ahead * (depth + height * place.z());
    }
    [[nodiscard]] Vec3d to_model(const Vec3d& place) const {
        return Vec3d(std::abs(across.dot(place) - offset), up.dot(place) - floor, ahead.dot(place) - depth) / height;
    }
};

/// Parts of the way from shoulder to fingertip, from the crotch to the neck, and from there to the top, in the mean
/// over people and characters, as place_of() has more of them.
inline constexpr double elbow_at = 0.43, wrist_at = 0.78, waist_at = 0.33, chest_at = 0.7, head_at = 0.45;

/// How long parts of a body are, in any unit: from the crotch to the neck, to the head's top, from the shoulder to the
/// fingertip, and from the hip to the ankle and half as far as the toes.
struct PartLengths {
    double trunk, head, arm, leg;
};

/// The template with its head from the joint on, arms below the shoulders and legs below the hips so many times as
/// large.
inline SkeletonTemplate with_sizes(const SkeletonTemplate& wanted, double head, double arms, double legs) {
    SkeletonTemplate out = wanted;
    out.is_adapted = true;
    for (std::size_t j = 0; j < out.joints.size(); ++j) {
        TemplateJoint& joint = out.joints[j];
        const TemplateJoint& before = wanted.joints[j];
        const BodyPart part = part_of(joint.role);
        const double size = part == BodyPart::arm           ? arms
                            : part == BodyPart::leg         ? legs
                            : joint.role == JointRole::head ? head
                                                            : 1;
        const bool is_trunks =
            joint.role == JointRole::shoulder || joint.role == JointRole::hip || joint.role == JointRole::head;
        if (joint.parent >= 0)
            joint.position = out.joint(joint.parent).position +
                             (is_trunks ? 1 : size) * (before.position - wanted.joint(joint.parent).position);
        joint.radius = size * before.radius;
        if (before.tip) joint.tip = joint.position + size * (*before.tip - before.position);
    }
    return out;
}

/// The template with head, arms and legs as long beside the trunk.
inline SkeletonTemplate with_lengths(const SkeletonTemplate& wanted, const PartLengths& lengths) {
    using enum JointRole;
    const auto place = [&](JointRole role, Side side) -> std::optional<Vec3d> {
        const int j = find_joint(wanted, role, side);
        return j >= 0 ? std::optional(wanted.joint(j).position) : std::nullopt;
    };
    auto top = place(neck, Side::none);
    if (!top) top = place(chest, Side::none);
    const double unit = lengths.trunk / std::max((*top - wanted.joint(0).position).norm(), 1e-9);
    const auto ratio = [&](double length, JointRole from, JointRole end) {
        const int joint = find_joint(wanted, end, end == head ? Side::none : Side::left);
        auto start = place(from, end == head ? Side::none : Side::left);
        if (!start) start = place(chest, Side::none);
        const TemplateJoint& last = wanted.joint(joint);
        const double rest = ((last.tip ? *last.tip : last.position) - *start).norm();
        return rest > 0 && unit > 0 ? length / (unit * rest) : 1;
    };
    return with_sizes(wanted, ratio(lengths.head, neck, head), ratio(lengths.arm, shoulder, hand),
                      ratio(lengths.leg, hip, foot));
}

/// Where a template's joint is on the model's half.
inline Vec3d place_of(const RestModel& model, const SkeletonTemplate& wanted, int joint) {
    using enum JointRole;
    constexpr double shoulder_at = 0.07, hand_at = 0.88, knee_at = 0.5, ankle_at = 0.955;
    constexpr double shoulder_lower = 0.004; // than the line of the arm's middle begins; of the height
    const auto between = [](const Vec3d& a, const Vec3d& b, double part) -> Vec3d { return a + part * (b - a); };
    switch (wanted.joint(joint).role) {
    case pelvis:
        return model.crotch;
    case waist:
        return between(model.crotch, model.neck, waist_at);
    case chest:
        return between(model.crotch, model.neck, chest_at);
    case neck:
        return model.neck;
    case head:
        return between(model.neck, model.top, head_at);
    case shoulder:
        return between(model.shoulder, model.fingertip, shoulder_at) - Vec3d(0, shoulder_lower, 0);
    case elbow:
        return between(model.shoulder, model.fingertip, elbow_at);
    case wrist:
        return between(model.shoulder, model.fingertip, wrist_at);
    case hand:
        return between(model.shoulder, model.fingertip, hand_at);
    case hip:
        return model.hip;
    case knee:
        return between(model.hip, model.ankle, knee_at);
    case ankle:
        return between(model.hip, model.ankle, ankle_at);
    case foot:
        return model.toe;
    default: // no person has it
        return model.crotch;
    }
}

} // namespace skelgen::search::detail
