#pragma once

#include <skelgen/hands/find_hands.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/hands/impl/digit_tubes.hpp>
#include <skelgen/hands/impl/hand_surface.hpp>
#include <skelgen/hands/impl/phalanges.hpp>
#include <skelgen/surface/clean.hpp>
#include <skelgen/surface/weld.hpp>
#include <skelgen/surface/winding_tree.hpp>

namespace skelgen::hands {
namespace detail {

/// The tubes of a hand and the surface that has them.
template <typename Scalar>
struct TubesOfHand {
    std::vector<DigitTube<Scalar>> tubes;
    TriangleMesh<Scalar> surface;
};

/// Surfaces of the whole body that hands are looked for on, made when they are asked for.
template <typename Scalar>
class BodySurfaces {
public:
    BodySurfaces(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body, const DigitBounds& bounds = {})
        : mesh_(mesh), body_(body), bounds_(bounds) {}

    /// The tubes of a hand, in the input's coordinates.
    [[nodiscard]] TubesOfHand<Scalar> tubes(const HandPlace<Scalar>& in_input) {
        const HandPlace<Scalar> in_body = moved(in_input, body_.similarity);
        if (const auto own = hand_surface(body_.mesh, in_body); own && is_fine(*own))
            return tubes_on(*own, in_body, body_.similarity);
        if (!material_) look_for_pieces();
        TubesOfHand<Scalar> found = tubes_of_piece(material_->clean, in_input);
        if (found.tubes.size() == all_digits.size()) return found;
        // A hand of several pieces shows more of its digits in an envelope around all of them.
        if (TubesOfHand<Scalar> around = tubes_around(material_->clean, in_input);
            around.tubes.size() >= found.tubes.size())
            found = std::move(around);
        // What is put right in a mesh may cost it fingers: of thin gloves, whose faces lie on each other.
        if (found.tubes.size() < all_digits.size() && material_->is_cleaned) {
            if (!material_->raw)
                material_->raw.emplace(surface::weld(in_body_coordinates(), Scalar(0)).mesh, body_.similarity);
            TubesOfHand<Scalar> of_raw = tubes_around(*material_->raw, in_input);
            if (of_raw.tubes.size() > found.tubes.size()) found = std::move(of_raw);
        }
        return found;
    }

private:
    /// Is a hand's surface that of the input itself, in enough vertices?
    [[nodiscard]] bool is_fine(const HandSurface<Scalar>& hand) const {
        constexpr std::size_t least_vertices = 150; // 30 a digit
        constexpr double own_share = 0.9;
        if (hand.source.size() < least_vertices || body_.dropped_pieces > 0) return false;
        const auto own = std::count_if(hand.source.begin(), hand.source.end(),
                                       [&](int v) { return body_.source[static_cast<std::size_t>(v)] >= 0; });
        return static_cast<double>(own) >= own_share * static_cast<double>(hand.source.size());
    }

    /// Faces that enclose the body, and where they are.
    struct Pieces {
        Pieces(TriangleMesh<Scalar> faces, const Similarity<Scalar>& from_input)
            : mesh(std::move(faces)), similarity(from_input), tree(mesh) {}
        TriangleMesh<Scalar> mesh;
        Similarity<Scalar> similarity;
        surface::WindingTree<Scalar> tree;
    };
    struct Material {
        Pieces clean;
        bool is_cleaned = false; ///< else the body's surface
        std::optional<Pieces> raw = std::nullopt;
    };

    /// A body's surface that is the input's own serves as it is.
    void look_for_pieces() {
        const auto added = std::count(body_.source.begin(), body_.source.end(), -1);
        constexpr std::ptrdiff_t closed_holes = 20; // one in as many vertices
        if (body_.dropped_pieces == 0 && closed_holes * added <= std::ssize(body_.source)) {
            material_.emplace(Material{Pieces(body_.mesh, body_.similarity)});
            return;
        }
        surface::CleanMesh<Scalar> clean = surface::clean_in_own_axes(mesh_);
        material_.emplace(Material{Pieces(std::move(clean.mesh), clean.similarity), true});
    }

    [[nodiscard]] TriangleMesh<Scalar> in_body_coordinates() const {
        TriangleMesh<Scalar> out = mesh_;
        for (Eigen::Index v = 0; v < out.vertices.rows(); ++v)
            core::set_point<Scalar>(out.vertices, v, body_.similarity.to_canonical(core::point(mesh_.vertices, v)));
        return out;
    }

    /// The tubes on an envelope of the arm's pieces; of all where these have none.
    [[nodiscard]] TubesOfHand<Scalar> tubes_around(const Pieces& pieces, const HandPlace<Scalar>& in_input) const {
        const HandPlace<Scalar> place = moved(in_input, pieces.similarity);
        const auto within = [&](const TriangleMesh<Scalar>& mesh, const surface::WindingTree<Scalar>& tree) {
            const auto around = hand_surface(hand_envelope(mesh, tree, place), place);
            return around ? tubes_on(*around, place, pieces.similarity) : TubesOfHand<Scalar>{};
        };
        if (const auto own = arm_pieces(pieces.mesh, place)) {
            TubesOfHand<Scalar> found = within(*own, surface::WindingTree<Scalar>(*own));
            if (!found.tubes.empty()) return found;
        }
        return within(pieces.mesh, pieces.tree);
    }

    /// The same on the faces themselves.
    [[nodiscard]] TubesOfHand<Scalar> tubes_of_piece(const Pieces& pieces, const HandPlace<Scalar>& in_input) const {
        const HandPlace<Scalar> place = moved(in_input, pieces.similarity);
        const auto own = arm_pieces(pieces.mesh, place);
        const auto hand = own_hand_surface(own ? *own : pieces.mesh, place);
        return hand ? tubes_on(*hand, place, pieces.similarity) : TubesOfHand<Scalar>{};
    }

    static HandPlace<Scalar> moved(HandPlace<Scalar> place, const Similarity<Scalar>& similarity) {
        for (Vector3<Scalar>* const each : {&place.elbow, &place.wrist, &place.knuckles, &place.tip})
            *each = similarity.to_canonical(*each);
        return place;
    }

    /// In the input's coordinates.
    [[nodiscard]] TubesOfHand<Scalar> tubes_on(const HandSurface<Scalar>& hand, const HandPlace<Scalar>& place,
                                               const Similarity<Scalar>& similarity) const {
        TubesOfHand<Scalar> out{find_tubes(hand, place, bounds_), hand.mesh};
        for (DigitTube<Scalar>& tube : out.tubes) {
            for (Vector3<Scalar>& on_axis : tube.axis) on_axis = similarity.to_input(on_axis);
            for (Vector3<Scalar>& point : tube.points) point = similarity.to_input(point);
            for (Scalar& radius : tube.radii) radius *= similarity.scale;
            for (Scalar& area : tube.areas) area *= similarity.scale * similarity.scale;
            tube.joins *= similarity.scale;
            tube.ends *= similarity.scale;
        }
        for (Eigen::Index v = 0; v < out.surface.vertices.rows(); ++v)
            core::set_point<Scalar>(out.surface.vertices, v, similarity.to_input(core::point(hand.mesh.vertices, v)));
        return out;
    }

    const TriangleMesh<Scalar>& mesh_;
    const Body<Scalar>& body_;
    DigitBounds bounds_;
    std::optional<Material> material_;
};

/// The skeleton with joints and end points of all digits of a kind below the joint of that name.
template <typename Scalar>
KinematicSkeleton<Scalar> with_joints_of(DigitKind kind, const std::string& below, KinematicSkeleton<Scalar> skeleton,
                                         const std::vector<Hand<Scalar>>& hands) {
    for (const Side side : {Side::left, Side::right}) {
        const int carrier = find_joint(skeleton, std::string(side_prefix(side)) + below);
        if (carrier < 0) continue;
        const Vector3<Scalar> otherwise = skeleton.joints[static_cast<std::size_t>(carrier)].position;
        const auto hand = std::find_if(hands.begin(), hands.end(), [&](const auto& each) { return each.side == side; });
        for (const Digit digit : all_digits) {
            const FoundDigit<Scalar>* found = nullptr;
            if (hand != hands.end())
                for (const FoundDigit<Scalar>& each : hand->digits)
                    if (each.digit == digit) found = &each;
            int parent = carrier;
            for (std::size_t k = 0; k < joints_of(kind); ++k) {
                Joint<Scalar> joint;
                joint.name = joint_name(side, digit, k + 1, kind);
                joint.parent = parent;
                joint.is_present = found != nullptr;
                joint.confidence = found ? found->confidence : 0;
                joint.position = found ? found->joints[k] : otherwise;
                joint.radius = found ? found->radii[k] : Scalar(0);
                parent = static_cast<int>(skeleton.joints.size());
                skeleton.joints.push_back(std::move(joint));
            }
            if (found) skeleton.end_points.emplace_back(tip_name(side, digit, kind), found->tip);
        }
    }
    return skeleton;
}

} // namespace detail

template <typename Scalar>
std::vector<Hand<Scalar>> find_hands(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                                     const KinematicSkeleton<Scalar>& skeleton) {
    detail::BodySurfaces<Scalar> surfaces(mesh, body);
    std::vector<Hand<Scalar>> hands;
    for (const Side side : {Side::left, Side::right}) {
        const auto place = hand_place(skeleton, side);
        if (!place) continue;
        const int wrist = find_joint(skeleton, std::string(side_prefix(side)) + "wrist");
        detail::TubesOfHand<Scalar> found = surfaces.tubes(*place);
        Hand<Scalar> hand{side, name_digits(found.tubes, *place, side), std::move(found.surface)};
        for (FoundDigit<Scalar>& digit : hand.digits)
            digit.confidence *= skeleton.joints[static_cast<std::size_t>(wrist)].confidence;
        hands.push_back(std::move(hand));
    }
    return hands;
}

template <typename Scalar>
std::vector<Hand<Scalar>> find_feet(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                                    const KinematicSkeleton<Scalar>& skeleton) {
    // Little toes of FAUST's bodies stand out by 0.057 and more, join beyond 1.0; what lies behind the ball is no toe.
    constexpr DigitBounds bounds{0.045, 0.9};
    detail::BodySurfaces<Scalar> surfaces(mesh, body, bounds);
    std::vector<Hand<Scalar>> feet;
    for (const Side side : {Side::left, Side::right}) {
        const auto place = toes_place(skeleton, side);
        if (!place) continue;
        const auto joint = [&](const char* name) -> const Joint<Scalar>& {
            return skeleton
                .joints[static_cast<std::size_t>(find_joint(skeleton, std::string(side_prefix(side)) + name))];
        };
        detail::TubesOfHand<Scalar> found = surfaces.tubes(*place);
        const Vector3<Scalar> up = joint("ankle").position - joint("foot").position;
        Hand<Scalar> foot{side, name_toes<Scalar>(found.tubes, *place, side, up), std::move(found.surface),
                          DigitKind::toe};
        for (FoundDigit<Scalar>& toe : foot.digits) toe.confidence *= joint("foot").confidence;
        feet.push_back(std::move(foot));
    }
    return feet;
}

template <typename Scalar>
KinematicSkeleton<Scalar> with_digits(KinematicSkeleton<Scalar> skeleton, const std::vector<Hand<Scalar>>& hands) {
    skeleton.template_name = template_with_digits;
    return detail::with_joints_of(DigitKind::finger, "wrist", std::move(skeleton), hands);
}

template <typename Scalar>
KinematicSkeleton<Scalar> with_toes(KinematicSkeleton<Scalar> skeleton, const std::vector<Hand<Scalar>>& feet) {
    return detail::with_joints_of(DigitKind::toe, "foot", std::move(skeleton), feet);
}

template <typename Scalar>
KinematicSkeleton<Scalar> without_digits(KinematicSkeleton<Scalar> skeleton) {
    for (const DigitKind kind : {DigitKind::finger, DigitKind::toe}) {
        if (kind == DigitKind::finger && skeleton.template_name != template_with_digits) continue;
        for (const Side side : {Side::left, Side::right})
            for (const Digit digit : all_digits) {
                for (std::size_t k = joints_of(kind); k > 0; --k) { // from the last on: none is another's parent then
                    const int j = find_joint(skeleton, joint_name(side, digit, k, kind));
                    if (j < 0) continue;
                    skeleton.joints.erase(skeleton.joints.begin() + j);
                    for (Joint<Scalar>& joint : skeleton.joints)
                        if (joint.parent > j) --joint.parent;
                }
                std::erase_if(skeleton.end_points,
                              [&](const auto& each) { return each.first == tip_name(side, digit, kind); });
            }
    }
    if (skeleton.template_name == template_with_digits) skeleton.template_name = "human21";
    return skeleton;
}

} // namespace skelgen::hands
