#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::hands {

/// The digits of a hand in the order in which they stand.
enum class Digit { thumb, index, middle, ring, little };

inline constexpr std::array<Digit, 5> all_digits{Digit::thumb, Digit::index, Digit::middle, Digit::ring, Digit::little};
inline constexpr std::size_t phalanges = 3; ///< joints of a digit; the thumb's first is that of its metacarpal

[[nodiscard]] constexpr std::string_view name_of(Digit digit) {
    constexpr std::array<std::string_view, 5> names{"thumb", "index", "middle", "ring", "little"};
    return names[static_cast<std::size_t>(digit)];
}

/// Of hands or of feet. The toes are those digits from the big one on.
enum class DigitKind { finger, toe };

/// What a digit of that kind is called: thumb to little, toe1 (the big one) to toe5.
[[nodiscard]] inline std::string name_of(Digit digit, DigitKind kind) {
    return kind == DigitKind::toe ? "toe" + std::to_string(static_cast<int>(digit) + 1) : std::string(name_of(digit));
}

/// How many joints a digit of that kind has.
[[nodiscard]] constexpr std::size_t joints_of(DigitKind kind) { return kind == DigitKind::toe ? 2 : phalanges; }

/// What a joint of a digit is called: left_index_1 at the knuckle, to 3; left_toe1_1 at the ball of the foot, to 2.
[[nodiscard]] inline std::string joint_name(Side side, Digit digit, std::size_t number,
                                            DigitKind kind = DigitKind::finger) {
    return std::string(side_prefix(side)).append(name_of(digit, kind)) + "_" + std::to_string(number);
}

/// What the end of a digit on the surface is called: left_index_tip, left_toe1_tip.
[[nodiscard]] inline std::string tip_name(Side side, Digit digit, DigitKind kind = DigitKind::finger) {
    return std::string(side_prefix(side)).append(name_of(digit, kind)) + "_tip";
}

/// A joint of a digit, by its name.
struct DigitJoint {
    Digit digit = Digit::thumb;
    std::size_t number = 1; ///< from 1 at the knuckle to 3
};

/// What joint of a finger has that name, without its side: index_1; none where it is none.
[[nodiscard]] inline std::optional<DigitJoint> digit_joint(std::string_view plain_name) {
    for (const Digit digit : all_digits)
        for (std::size_t number = 1; number <= phalanges; ++number)
            if (plain_name == joint_name(Side::none, digit, number)) return DigitJoint{digit, number};
    return std::nullopt;
}

/// A digit that was found, or several that are one on the surface.
template <typename Scalar = double>
struct FoundDigit {
    Digit digit = Digit::thumb;
    std::vector<Digit> fused = {};                 ///< those that are one with it, after it in their order
    std::array<Vector3<Scalar>, phalanges> joints; ///< from the knuckle to the last one; a toe's two, and its tip
    std::array<Scalar, phalanges> radii{};         ///< mean distance from the axis to the surface there
    Vector3<Scalar> tip = Vector3<Scalar>::Zero(); ///< on the surface
    /// About which it bends, of length 1: positive turns bring the tip towards palm or sole, the thumb's across it.
    Vector3<Scalar> hinge = Vector3<Scalar>::Zero();
    double confidence = 0;                         ///< 0 to 1: how far it stands apart, and how sure the wrist is
    Vector3<Scalar> web = Vector3<Scalar>::Zero(); ///< on its axis, where it joins its neighbours
    std::vector<int> vertices = {};                ///< of the hand's surface beyond that
};

/// A hand, or a foot, and what digits its surface shows: none that it does not show.
template <typename Scalar = double>
struct Hand {
    Side side = Side::none;
    std::vector<FoundDigit<Scalar>> digits = {}; ///< in their order
    TriangleMesh<Scalar> surface = {};           ///< of the hand, that they were found on
    DigitKind kind = DigitKind::finger;
};

} // namespace skelgen::hands
