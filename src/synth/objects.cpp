#include <skelgen/synth/objects.hpp>

#include <algorithm>
#include <array>
#include <memory>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/synth/body.hpp>
#include <skelgen/synth/quadrupeds.hpp>

#include "anatomy.hpp"
#include "implicit_body.hpp"
#include "surface_mesher.hpp"

namespace skelgen::synth {
namespace {

constexpr double far_away = 1e3;
constexpr const char* dog = "dog"; ///< the first of the animals

ImplicitSurface even_surface(std::function<double(const Vec3&)> field, const Vec3& inside, double radius) {
    return {std::move(field), [](const Vec3&) { return 1.0; }, inside, radius};
}

ImplicitSurface surface_of(std::vector<Blob> blobs, const Vec3& inside, double radius) {
    set_bounds(blobs);
    return even_surface([blobs = std::move(blobs)](const Vec3& p) { return evaluate(blobs, p, far_away); }, inside,
                        radius);
}

/// Distance to a box with rounded edges.
double round_box(const Vec3& p, const Vec3& centre, const Vec3& half, double rounding) {
    const Vec3 out = (p - centre).cwiseAbs() - half + Vec3::Constant(rounding);
    return out.cwiseMax(0.0).norm() + std::min(out.maxCoeff(), 0.0) - rounding;
}

struct Box {
    Vec3 centre;
    Vec3 half;
};

ImplicitSurface surface_of(std::vector<Box> boxes, const Vec3& inside, double radius) {
    return even_surface(
        [boxes = std::move(boxes)](const Vec3& p) {
            double field = far_away;
            for (const Box& box : boxes) field = smooth_union(field, round_box(p, box.centre, box.half, 0.008), 0.006);
            return field;
        },
        inside, radius);
}

std::vector<Box> four_legs(double x, double y, double height, double thick) {
    std::vector<Box> legs;
    for (const double sx : {1.0, -1.0})
        for (const double sy : {1.0, -1.0}) legs.push_back({{sx * x, sy * y, height / 2}, {thick, thick, height / 2}});
    return legs;
}

ImplicitSurface table() {
    std::vector<Box> boxes = four_legs(0.60, 0.32, 0.72, 0.032);
    boxes.push_back({{0, 0, 0.735}, {0.70, 0.40, 0.020}});
    return surface_of(std::move(boxes), {0, 0, 0.735}, 1.2);
}

ImplicitSurface chair() {
    std::vector<Box> boxes = four_legs(0.20, 0.20, 0.45, 0.022);
    boxes.push_back({{0, 0, 0.45}, {0.23, 0.23, 0.020}});
    for (const double side : {1.0, -1.0}) boxes.push_back({{side * 0.20, 0.20, 0.68}, {0.020, 0.020, 0.24}});
    boxes.push_back({{0, 0.20, 0.80}, {0.22, 0.016, 0.12}});
    return surface_of(std::move(boxes), {0, 0, 0.45}, 0.8);
}

ImplicitSurface single_hand() {
    const Proportions proportions = proportions_of({});
    return surface_of(hand(proportions, {}).blobs, {0, 0, 0.05}, 0.25);
}

ImplicitSurface single_head() { return surface_of(head(proportions_of({})), {0, 0, 0.05}, 0.3); }

ImplicitSurface sphere() {
    return even_surface([](const Vec3& p) { return p.norm() - 0.5; }, Vec3::Zero(), 0.7);
}

ImplicitSurface torus() {
    return even_surface([](const Vec3& p) { return Eigen::Vector2d(p.head<2>().norm() - 0.5, p.z()).norm() - 0.18; },
                        {0.5, 0, 0}, 1.3);
}

/// Two bodies in one mesh, the second one moved; where they meet they are one.
ImplicitSurface two_people(const BodyPose& pose, const BodyPose& other_pose, const Vec3& offset) {
    const auto one = std::make_shared<ImplicitBody>(proportions_of({}), pose);
    BodyShape other_shape;
    other_shape.masculinity = 0;
    const auto other = std::make_shared<ImplicitBody>(proportions_of(other_shape), other_pose);
    return {[one, other, offset](const Vec3& p) { return smooth_union((*one)(p), (*other)(p - offset), 0.004); },
            [one, other, offset](const Vec3& p) { return std::min(one->grain(p), other->grain(p - offset)); },
            one->skeleton().position(BodyJoint::crotch), offset.norm() + 1.4};
}

ImplicitSurface two_people_holding_hands() {
    const BodyPose pose = spread_limbs({}, named_pose("a"));
    const ImplicitBody man(proportions_of({}), pose);
    BodyShape woman;
    woman.masculinity = 0;
    const ImplicitBody other(proportions_of(woman), pose);
    // Her right hand in his left one.
    const Vec3 offset =
        man.skeleton().position(BodyJoint::left_hand) - other.skeleton().position(BodyJoint::right_hand);
    return two_people(pose, pose, offset);
}

ImplicitSurface two_people_side_by_side() {
    const BodyPose pose = spread_limbs({}, named_pose("arms-down"));
    return two_people(pose, pose, {0.46, 0.02, 0});
}

struct NamedObject {
    const char* name;
    ImplicitSurface (*surface)();
};

constexpr std::array<NamedObject, 8> objects{{{"chair", chair},
                                              {"table", table},
                                              {"hand", single_hand},
                                              {"head", single_head},
                                              {"two-people-holding-hands", two_people_holding_hands},
                                              {"two-people-side-by-side", two_people_side_by_side},
                                              {"sphere", sphere},
                                              {"torus", torus}}};

} // namespace

std::vector<std::string> object_names() {
    std::vector<std::string> names{dog};
    for (const NamedObject& object : objects) names.emplace_back(object.name);
    return names;
}

TriangleMesh<double> synthesize_object(std::string_view name, int faces) {
    if (faces < least_faces || faces > most_faces)
        throw Error(ErrorCode::usage, std::to_string(faces) + " faces is out of range: give " +
                                          std::to_string(least_faces) + " to " + std::to_string(most_faces));
    if (name == dog) return synthesize_quadruped(quadruped_plans(1, 1).front(), faces);
    for (const NamedObject& object : objects)
        if (name == object.name) return mesh_surface(object.surface(), faces, false);
    std::string what = "there is no object " + std::string(name) + ": give one of";
    for (const std::string& known : object_names()) what += " " + known;
    throw Error(ErrorCode::usage, what);
}

std::string object_truth_to_json(const std::string& mesh_file) {
    nlohmann::ordered_json json;
    json["mesh"] = mesh_file;
    json["source"] = "skelgen synth: exact by construction";
    json["not_a_body"] = true;
    return json.dump(1) + "\n";
}

} // namespace skelgen::synth
