#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/hands/digit.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::hands {

/// The name of the template whose skeletons have digits.
inline constexpr std::string_view template_with_digits = "human51";

/// The hands of a body and their digits, as its surface shows them: the left one and the right one where the skeleton
/// has them, perhaps without digits. `skeleton` is finished and in the coordinates of `mesh`, and so is what is
/// returned; `body` was made of that mesh. Looked at is the body's surface. Where that is none of the mesh's own, or
/// has few triangles at the hand, it is the hand's own piece, or an envelope around the hand alone: what shows more
/// digits. Things that are pieces of their own and leave the hand are left out of both. O(faces log faces).
template <typename Scalar>
[[nodiscard]] std::vector<Hand<Scalar>> find_hands(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                                                   const KinematicSkeleton<Scalar>& skeleton);

/// The feet of a body and the toes that its surface shows, as `find_hands` finds digits: none below shoes, nor where
/// the triangles are too large to show them.
template <typename Scalar>
[[nodiscard]] std::vector<Hand<Scalar>> find_feet(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                                                  const KinematicSkeleton<Scalar>& skeleton);

/// The skeleton with the joints and end points of all digits (human51): after its own, by side and digit, those of each
/// from its knuckle on, with the wrist as parent of the first; digits that were not found are not present.
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> with_digits(KinematicSkeleton<Scalar> skeleton,
                                                    const std::vector<Hand<Scalar>>& hands);

/// The skeleton with those of all toes, likewise: two joints each, left_toe1_1 and on, below the foot's.
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> with_toes(KinematicSkeleton<Scalar> skeleton,
                                                  const std::vector<Hand<Scalar>>& feet);

/// The skeleton without digits (human21) and toes; one without either comes back as it is. O(joints).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> without_digits(KinematicSkeleton<Scalar> skeleton);

/// Does the surface show digits, and not only hands that are one each?
template <typename Scalar>
[[nodiscard]] bool has_digits(const std::vector<Hand<Scalar>>& hands) {
    for (const Hand<Scalar>& hand : hands)
        if (hand.digits.size() > 1) return true;
    return false;
}

/// The digits that are one with another one, by the name of its first joint.
template <typename Scalar>
[[nodiscard]] std::vector<std::pair<std::string, std::vector<std::string>>>
fused_digits(const std::vector<Hand<Scalar>>& hands) {
    std::vector<std::pair<std::string, std::vector<std::string>>> out;
    for (const Hand<Scalar>& hand : hands)
        for (const FoundDigit<Scalar>& digit : hand.digits) {
            if (digit.fused.empty()) continue;
            auto& [joint, names] =
                out.emplace_back(joint_name(hand.side, digit.digit, 1, hand.kind), std::vector<std::string>{});
            for (const Digit other : digit.fused) names.push_back(name_of(other, hand.kind));
        }
    return out;
}

} // namespace skelgen::hands

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/hands/impl/find_hands.hpp>
#endif
