#include "compared_file.hpp"

#include <cstddef>
#include <utility>

#include <skelgen/applications/body_coordinates.hpp>

namespace skelgen::cli {

FoundCorrespondence correspondence_of(const ComparedBody& from, const ComparedBody& to,
                                      const CorrespondenceExtras& extras) {
    const applications::Correspondence found = applications::correspond(from.comparable, to.comparable);
    const std::vector<int> from_mesh = applications::vertices_of_input(from.body, from.mesh);
    const std::vector<int> to_mesh = applications::vertices_of_input(to.body, to.mesh);
    std::vector<applications::TrianglePlace> places;
    if (extras.places) places = applications::triangle_places(to.mesh, to.body, to.comparable, found);
    FoundCorrespondence out{{from.source, to.source, from.quality, to.quality, {}, {}, {}}, {}};
    for (const int v : applications::standing_for(from.body, from.mesh.vertices)) {
        const auto at = static_cast<std::size_t>(v);
        out.to_body_vertex.push_back(found.map[at]);
        out.file.vertex_to_vertex.push_back(to_mesh[static_cast<std::size_t>(found.map[at])]);
        if (extras.confidence) out.file.confidence.push_back(found.confidence[at]);
        if (extras.places) out.file.places.push_back(places[at]);
    }
    for (const applications::Landmark& landmark : applications::landmarks(from.comparable, found))
        out.file.landmarks.push_back({landmark.name, from_mesh[static_cast<std::size_t>(landmark.from)],
                                      to_mesh[static_cast<std::size_t>(landmark.to)]});
    return out;
}

ComparedFile compared(FittedFile file) {
    auto comparable = applications::comparable(file.found.body, file.skeleton());
    return {std::move(file), std::move(comparable)};
}

} // namespace skelgen::cli
