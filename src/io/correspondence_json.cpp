#include <skelgen/io/correspondence_json.hpp>

#include <utility>

#include "application_json.hpp"

namespace skelgen::io {

std::string correspondence_to_json(const CorrespondenceFile& correspondence) {
    using detail::Json;
    Json landmarks = Json::array();
    for (const NamedPair& pair : correspondence.landmarks)
        landmarks.push_back({{"name", detail::valid_utf8(pair.name)}, {"from", pair.from}, {"to", pair.to}});
    Json file{
        {"format", "skelgen-correspondence"},
        {"version", 1},
        {"from", detail::to_json(correspondence.from)},
        {"to", detail::to_json(correspondence.to)},
        {"landmarks", landmarks},
        {"vertex_to_vertex", correspondence.vertex_to_vertex},
        {"quality",
         {{"from", detail::to_json(correspondence.from_quality)}, {"to", detail::to_json(correspondence.to_quality)}}}};
    if (!correspondence.confidence.empty()) file["confidence"] = correspondence.confidence;
    if (!correspondence.places.empty()) {
        Json faces = Json::array(), weights = Json::array();
        for (const applications::TrianglePlace& place : correspondence.places) {
            faces.push_back(place.face);
            weights.push_back(place.weights);
        }
        file["vertex_to_face"] = std::move(faces);
        file["face_weights"] = std::move(weights);
    }
    return file.dump() + "\n";
}

} // namespace skelgen::io
