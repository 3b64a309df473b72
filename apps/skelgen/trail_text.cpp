#include "trail_text.hpp"

#include <cstdio>
#include <string>

namespace skelgen::cli {
namespace {

std::string outcome_text(const search::Tried& tried) {
    if (tried.candidates == 0) return std::string(to_string(tried.refusal));
    char text[64];
    std::snprintf(text, sizeof text, "found, probability %.2f%s", tried.probability,
                  tried.lacks_limb ? ", a limb is lacking" : "");
    return text;
}

std::string hypothesis_text(const search::Hypothesis& what) {
    return std::string(search::to_string(what.surface)) + ", " + std::string(search::to_string(what.effort));
}

} // namespace

void print_trail(const std::filesystem::path& mesh, const search::Trail& trail) {
    for (const search::Tried& tried : trail)
        std::fprintf(stderr, "%s: tried %s: %s (%.0f ms)\n", mesh.filename().c_str(),
                     hypothesis_text(tried.hypothesis).c_str(), outcome_text(tried).c_str(), 1000 * tried.seconds);
}

} // namespace skelgen::cli
