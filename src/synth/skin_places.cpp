#include <skelgen/synth/skin_places.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "body_surface.hpp"

namespace skelgen::synth {
namespace {

constexpr int part_index(PartName name) { return static_cast<int>(name); }
bool is_hand(int part) { return part == part_index(PartName::left_hand) || part == part_index(PartName::right_hand); }
bool is_foot(int part) { return part == part_index(PartName::left_foot) || part == part_index(PartName::right_foot); }
bool is_trunk(int part) { return part == part_index(PartName::trunk); }
bool is_head(int part) { return part == part_index(PartName::head); }

int side_of_part(int part) {
    if (is_trunk(part) || is_head(part)) return 0;
    return ((part - part_index(PartName::left_upper_arm)) / 3) % 2 == 0 ? 1 : -1;
}

} // namespace

/// The field that a body's skin comes from.
struct SkinPlaces::Skin {
    Proportions proportions;
    ImplicitBody field;
    Vec3 lift;                    ///< from the field's coordinates to the body's
    std::array<Vec3, 6> column{}; ///< of the rest pose's trunk, from between the hips to the head

    Skin(const BodyPlan& plan, const SynthBody& body)
        : proportions(proportions_of(plan.shape)), field(dressed_field(plan, proportions)),
          lift(body.truth.joints[0] - field.skeleton().position(BodyJoint::crotch)) {
        const PosedSkeleton& s = field.skeleton();
        column[0] = (s.rest_position(BodyJoint::left_hip) + s.rest_position(BodyJoint::right_hip)) / 2;
        constexpr std::array<BodyJoint, 5> joints{BodyJoint::crotch, BodyJoint::waist, BodyJoint::chest,
                                                  BodyJoint::neck, BodyJoint::head};
        for (std::size_t i = 0; i < joints.size(); ++i) column[i + 1] = s.rest_position(joints[i]);
    }

    /// How far from the skin of its own part a point of the surface may be: where parts blend it lies that far out.
    [[nodiscard]] double tolerance() const { return 0.01 * proportions.scale; }

    /// What hands and feet are sized by.
    [[nodiscard]] double size_of(int part) const {
        return is_hand(part) ? proportions.hand_scale : proportions.foot_scale;
    }

    /// A limb's bone in its own coordinates; of the head a place in the middle of it.
    [[nodiscard]] std::pair<Vec3, Vec3> bone(int part) const {
        if (is_head(part))
            return {0.03 * proportions.head_scale * Vec3::UnitZ(), 0.05 * proportions.head_scale * Vec3::UnitZ()};
        return {Vec3::Zero(), field.part(static_cast<PartName>(part)).length * Vec3::UnitZ()};
    }

    /// The point of the trunk's column at a place along it.
    [[nodiscard]] Vec3 on_column(double along) const {
        const auto i = static_cast<std::size_t>(std::clamp(along, 0.0, 4.999));
        return column[i] + (along - static_cast<double>(i)) * (column[i + 1] - column[i]);
    }

    /// How far up the column a height of the rest pose is; 0 and 5 beyond its ends.
    [[nodiscard]] double along_column(double height) const {
        for (std::size_t i = 0; i + 1 < column.size(); ++i)
            if (height <= column[i + 1].z())
                return static_cast<double>(i) +
                       std::clamp((height - column[i].z()) / (column[i + 1].z() - column[i].z()), 0.0, 1.0);
        return 5;
    }

    /// The point of the part's own skin that a ray in the part's coordinates leaves it at for good.
    [[nodiscard]] std::optional<Vec3> leaving(PartName name, const Vec3& from, const Vec3& direction) const {
        constexpr int steps = 200;
        const double reach = 0.6 * std::max(proportions.scale, proportions.head_scale);
        const auto world = [&](double t) -> Vec3 {
            const Vec3 local = from + t * direction;
            return name == PartName::trunk ? field.trunk_to_world(local) : field.part(name).to_world(local);
        };
        const auto value = [&](double t) { return field.part_alone(name, world(t)); };
        for (int i = steps; i > 0; --i) {
            double inside = reach * (i - 1) / steps, outside = reach * i / steps;
            if (value(inside) >= 0) continue;
            for (int k = 0; k < 30; ++k) {
                const double middle = (inside + outside) / 2;
                (value(middle) < 0 ? inside : outside) = middle;
            }
            return world(inside);
        }
        return std::nullopt;
    }

    /// The point of the part's skin nearest to one close to it, by its gradient.
    [[nodiscard]] Vec3 onto(PartName name, Vec3 p) const {
        constexpr double step = 1e-4;
        for (int i = 0; i < 20; ++i) {
            Vec3 gradient;
            for (int axis = 0; axis < 3; ++axis) {
                const Vec3 h = step * Vec3::Unit(axis);
                gradient[axis] = (field.part_alone(name, p + h) - field.part_alone(name, p - h)) / (2 * step);
            }
            if (gradient.squaredNorm() < 1e-6) break;
            p -= 0.7 * field.part_alone(name, p) / gradient.squaredNorm() * gradient;
        }
        return p;
    }
};

SkinPlaces::SkinPlaces(const BodyPlan& plan, const SynthBody& body) : skin_(std::make_shared<const Skin>(plan, body)) {}

std::optional<SkinPlace> SkinPlaces::place_of(const Vector3<double>& point) const {
    constexpr double knuckles = 0.08; // of a hand of size 1 from the wrist
    const Vec3 p = point - skin_->lift;
    SkinPlace place;
    double nearest = std::numeric_limits<double>::infinity();
    for (int part = 0; part < part_count; ++part) {
        const auto name = static_cast<PartName>(part);
        if (skin_->field.part(name).absent) continue;
        const double value = std::abs(skin_->field.part_alone(name, p));
        if (value < nearest) nearest = value, place.part = part;
    }
    if (!(nearest < skin_->tolerance()) || std::abs(skin_->field(p)) > skin_->tolerance()) return std::nullopt;
    place.side = side_of_part(place.part);
    const Vec3 local = skin_->field.in_part(static_cast<PartName>(place.part), p);
    if (is_hand(place.part) || is_foot(place.part)) {
        place.from_bone = local / skin_->size_of(place.part);
        if (is_hand(place.part) && place.from_bone.z() > knuckles) return std::nullopt;
        return place;
    }
    Vec3 from = Vec3::Zero();
    if (is_trunk(place.part)) {
        place.along = skin_->along_column(local.z());
        from = skin_->on_column(place.along);
    } else {
        const auto [low, high] = skin_->bone(place.part);
        place.along = std::clamp((local.z() - low.z()) / (high.z() - low.z()), 0.0, 1.0);
        from = low + place.along * (high - low);
    }
    place.from_bone = (local - from).normalized();
    const std::optional<Vec3> back = point_at(place);
    if (!back || (*back - point).norm() > 2 * skin_->tolerance()) return std::nullopt;
    return place;
}

std::optional<Vector3<double>> SkinPlaces::point_at(const SkinPlace& place) const {
    const auto name = static_cast<PartName>(place.part);
    const Part& part = skin_->field.part(name);
    if (part.absent) return std::nullopt;
    std::optional<Vec3> p;
    if (is_hand(place.part) || is_foot(place.part)) {
        const Vec3 wanted = part.to_world(skin_->size_of(place.part) * place.from_bone);
        p = skin_->onto(name, wanted);
        if ((*p - wanted).norm() > 2 * skin_->tolerance()) return std::nullopt;
    } else {
        const auto [low, high] = skin_->bone(place.part);
        const Vec3 from = is_trunk(place.part) ? skin_->on_column(place.along) : Vec3(low + place.along * (high - low));
        p = skin_->leaving(name, from, place.from_bone);
    }
    if (!p || std::abs(skin_->field(*p)) > skin_->tolerance()) return std::nullopt;
    return *p + skin_->lift;
}

} // namespace skelgen::synth
