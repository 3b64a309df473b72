#include <skelgen/io/segmentation_json.hpp>

#include "application_json.hpp"

namespace skelgen::io {

std::string segmentation_to_json(const applications::Segmentation& segmentation, const SourceMesh& mesh,
                                 const Quality& quality) {
    const detail::Json file{{"format", "skelgen-segmentation"},        {"version", 1},
                            {"mesh", detail::to_json(mesh)},           {"parts", segmentation.parts},
                            {"vertex_part", segmentation.vertex_part}, {"face_part", segmentation.face_part},
                            {"quality", detail::to_json(quality)}};
    return file.dump() + "\n";
}

} // namespace skelgen::io
