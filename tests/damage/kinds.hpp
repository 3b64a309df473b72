#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/io/truth_json.hpp>

#include "soup.hpp"

namespace skelgen::damage {

/// A sound body to be damaged.
struct Subject {
    Mesh mesh;
    std::optional<KinematicSkeleton<double>> skeleton; ///< of the mesh: where its limbs are
    std::uint64_t seed = 1;                            ///< the same seed gives the same bytes
};

/// What a surface stage has to survive.
struct Kind {
    std::string name;
    std::string what; ///< for users, a few words
    std::string extension = ".off";
    bool needs_skeleton = false;
    Mesh (*apply)(const Subject&) = nullptr;
    bool is_one_body = true; ///< otherwise the right answer is a refusal that says how many there are
    bool is_mirrored = false;
    std::vector<std::string> missing = {}; ///< joints that the body no longer has: the right answer says so
    bool is_surface = true;                ///< otherwise the right answer is to refuse it as bad input
};

/// All kinds, in the order of the tables.
[[nodiscard]] const std::vector<Kind>& kinds();

/// \throws Error usage naming the known kinds.
[[nodiscard]] const Kind& named_kind(std::string_view name);

/// The mesh damaged so. \throws Error bad_input when there is no skeleton and the kind needs one, or the mesh is none
/// that can be damaged this way (where no limb can be cut off, say).
[[nodiscard]] Mesh damaged(const Kind& kind, const Subject& subject);

/// Where the joints are after the damage.
[[nodiscard]] io::GroundTruth truth_after(const Kind& kind, io::GroundTruth truth);

} // namespace skelgen::damage
