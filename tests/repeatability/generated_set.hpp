#pragma once

#include <string>
#include <utility>
#include <vector>

#include <skelgen/synth/sets.hpp>
#include <skelgen/synth/skin_places.hpp>

#include "registered_set.hpp"

namespace skelgen::repeatability {

/// A generated body: what is said of it, and what is true.
struct GeneratedBody {
    synth::BodyPlan plan;
    test::Motion motion; ///< from where it was generated to where `found` is
    synth::SynthBody made;
    synth::SkinPlaces places;
    RegisteredBody found;

    /// The side of a vertex's place: 1 left, -1 right, 0 neither or not known.
    [[nodiscard]] int side_of(int vertex) const;
};

struct GeneratedSet {
    std::string name;
    std::vector<GeneratedBody> bodies;
    std::vector<std::string> failures; ///< what was no body, and why
};

/// Every `every`th body of sets that the generator knows, of several sets one after the other: first, first, second ...
[[nodiscard]] GeneratedSet generate(const std::vector<std::string>& sets, std::size_t every);

} // namespace skelgen::repeatability
