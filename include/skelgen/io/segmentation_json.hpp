#pragma once

#include <string>

#include <skelgen/applications/segmentation.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/io/skeleton_json.hpp>

namespace skelgen::io {

/// A segmentation as the text of its file (data/schema/segmentation.schema.json): JSON in UTF-8, with how sure the
/// sides are. O(n).
[[nodiscard]] std::string segmentation_to_json(const applications::Segmentation& segmentation, const SourceMesh& mesh,
                                               const Quality& quality);

} // namespace skelgen::io
