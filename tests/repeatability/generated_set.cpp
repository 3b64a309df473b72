#include "generated_set.hpp"

#include <algorithm>
#include <cstddef>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::repeatability {

int GeneratedBody::side_of(int vertex) const {
    const auto place = places.place_of(motion.undo(core::point(found.mesh.vertices, vertex)));
    return place ? place->side : 0;
}

GeneratedSet generate(const std::vector<std::string>& sets, std::size_t every) {
    constexpr std::uint64_t seed = 1;
    GeneratedSet out;
    std::vector<std::vector<synth::BodyPlan>> plans;
    std::size_t most = 0;
    for (const std::string& set : sets) {
        out.name += (out.name.empty() ? "" : " and ") + set;
        plans.push_back(synth::body_set(set, seed));
        most = std::max(most, plans.back().size());
    }
    for (std::size_t i = 0; i < most; i += every)
        for (const std::vector<synth::BodyPlan>& of_set : plans) {
            if (i >= of_set.size()) continue;
            const synth::BodyPlan& plan = of_set[i];
            const auto turn = static_cast<unsigned>(i);
            try {
                const synth::SynthBody made = synth::synthesize_body(plan);
                out.bodies.push_back(
                    {plan, motion_of(turn), made, synth::SkinPlaces(plan, made), body_of(plan.name, made.mesh, turn)});
            } catch (const Error& error) {
                out.failures.push_back(plan.name + ": " + error.what());
            }
        }
    return out;
}

} // namespace skelgen::repeatability
