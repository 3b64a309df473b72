#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skelgen::synth {

/// What a synthetic body can wear or carry.
enum class Garment {
    axe, ///< in the right hand, as staff and sword are
    boots,
    coat, ///< loose, from the neck to the knees, with sleeves
    hat,
    horns,
    long_hair, ///< down to the shoulder blades
    mittens,   ///< round ones that make paws of the hands
    rucksack,
    skirt, ///< to the knees; thighs disappear in it
    staff, ///< as long as the body is high
    sword,
    tail, ///< behind the pelvis, a third as long as the body is high
    trousers
};

/// The spellings in files and on the command line, in alphabetical order: "axe", "boots", ... "long-hair", ...
[[nodiscard]] std::vector<std::string> garment_names();

/// \throws Error usage naming the known garments.
[[nodiscard]] Garment named_garment(std::string_view name);

} // namespace skelgen::synth
