#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skelgen::synth {

/// What a synthetic body can wear or carry.
enum class Garment {
    axe, ///< in the right hand, as staff and sword are
    boots,
    bow,  ///< in the left hand, without its string
    bun,  ///< of hair, high at the back of the head
    cape, ///< from the shoulders to the knees, behind a standing body
    coat, ///< loose, from the neck to the knees, with sleeves
    hat,
    helmet, ///< open in front of the face
    horns,
    long_hair,      ///< down to the shoulder blades
    long_pony_tail, ///< down to the ankles of a standing body
    mittens,        ///< round ones that make paws of the hands
    pony_tail,      ///< down to the hips of a standing body
    rucksack,
    shield, ///< on the left forearm
    skirt,  ///< to the knees; thighs disappear in it
    staff,  ///< as long as the body is high
    sword,
    tail, ///< behind the pelvis, a third as long as the body is high
    trousers,
    wide_skirt, ///< to the ankles of a standing body; the legs disappear in it
    wings       ///< two pairs, on the back
};

/// The spellings in files and on the command line, in alphabetical order: "axe", "boots", ... "long-hair", ...
[[nodiscard]] std::vector<std::string> garment_names();

/// \throws Error usage naming the known garments.
[[nodiscard]] Garment named_garment(std::string_view name);

} // namespace skelgen::synth
