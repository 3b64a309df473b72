#include "parts.hpp"

#include <cstddef>

namespace skelgen::cli {

applications::Segmentation parts_of(const Extraction<double>& found, const std::string& set) {
    const auto which = set == "body" ? applications::PartSet::body : applications::PartSet::bones;
    return applications::to_input(applications::segment(found.body, found.skeleton, which), found.body, found.mesh);
}

std::vector<io::ByteColour> vertex_colours(const applications::Segmentation& parts) {
    const std::vector<io::ByteColour> palette = io::part_colours(parts.parts);
    std::vector<io::ByteColour> out;
    for (const int part : parts.vertex_part) out.push_back(palette[static_cast<std::size_t>(part)]);
    return out;
}

} // namespace skelgen::cli
