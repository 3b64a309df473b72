#include <skelgen/io/trail_json.hpp>

#include <nlohmann/json.hpp>

#include <skelgen/search/hypothesis.hpp>

namespace skelgen::io {

std::string trail_to_json(const search::Trail& trail) {
    using Json = nlohmann::ordered_json;
    Json tried = Json::array();
    for (const search::Tried& each : trail) {
        const search::Hypothesis& what = each.hypothesis;
        tried.push_back({{"surface", search::to_string(what.surface)},
                         {"opened", "opened"}, // always, and neither cut nor freed of what hands hold: the format's
                         {"cuts", 0},          // keys stay
                         {"held", "nothing"},
                         {"lacking", each.lacks_limb},
                         {"curve", search::to_string(what.effort)},
                         {"outcome", each.candidates > 0 ? "found" : to_string(each.refusal)},
                         {"probability", each.probability},
                         {"seconds", each.seconds}});
    }
    return Json{{"format", "skelgen-trail"}, {"version", 1}, {"tried", tried}}.dump(1) + "\n";
}

} // namespace skelgen::io
