#include "compared_file.hpp"

#include <cstddef>
#include <utility>

#include <skelgen/applications/body_coordinates.hpp>

namespace skelgen::cli {
namespace {

/// For each vertex of the body one of its mesh's, none of another body's.
std::vector<int> vertices_of_mesh(const ComparedBody& one) {
    if (!one.own) return applications::vertices_of_input(one.body, one.mesh);
    std::vector<int> vertices = applications::vertices_of_input(one.own->found.body, one.own->mesh());
    if (!one.own->part.is_all)
        for (int& v : vertices) v = one.own->part.vertices[static_cast<std::size_t>(v)];
    return vertices;
}

/// Where on the mesh the vertices are that were corresponded, on no other body's faces.
std::vector<applications::TrianglePlace> places_on_mesh(const ComparedBody& to,
                                                        const applications::Correspondence& found) {
    if (!to.own) return applications::triangle_places(to.mesh, to.body, to.comparable, found);
    auto places = applications::triangle_places(to.own->mesh(), to.own->found.body, to.comparable, found);
    if (!to.own->part.is_all)
        for (auto& place : places) place.face = to.own->part.faces[static_cast<std::size_t>(place.face)];
    return places;
}

} // namespace

FoundCorrespondence correspondence_of(const ComparedBody& from, const ComparedBody& to,
                                      const CorrespondenceExtras& extras) {
    const applications::Correspondence found = applications::correspond(from.comparable, to.comparable);
    const std::vector<int> from_mesh = vertices_of_mesh(from);
    const std::vector<int> to_mesh = vertices_of_mesh(to);
    std::vector<applications::TrianglePlace> places;
    if (extras.places) places = places_on_mesh(to, found);
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

ComparedFile compared(FittedFile file, int component) {
    auto comparable = applications::comparable(file.found.body, file.skeleton());
    std::optional<FittedFile> own;
    if (component > 0) own = with_own_part(file);
    return {std::move(file), std::move(comparable), std::move(own)};
}

} // namespace skelgen::cli
