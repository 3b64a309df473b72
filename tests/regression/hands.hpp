#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace skelgen::regression {

/// The set whose bodies have hands of all kinds: their skeletons are found with digits.
inline constexpr const char* hand_set = "hands";

/// How the digits of a set's hands are found. A hand's chains are its digits, those that are one on the surface as one.
struct HandScores {
    std::size_t hands = 0;       ///< of the bodies whose truth tells their digits, two each
    std::size_t counted = 0;     ///< with as many chains as the truth has: none where the hand is missing
    std::size_t thumbs = 0;      ///< with a thumb that is a chain in the truth and in the skeleton
    std::size_t told = 0;        ///< with something fused or missing, and chains of the very digits of the truth's
    std::optional<double> error; ///< median of the distances of joints, in geodesic diameters: of hands that are
                                 ///< counted right and have nothing fused
};

/// Compares the skeletons FOLDER/skeletons/<set> with the truths FOLDER/truth/<set>. What has no skeleton has no
/// digits. \throws Error bad_input when a file cannot be read.
[[nodiscard]] HandScores measure_hands(const std::filesystem::path& folder);

} // namespace skelgen::regression
