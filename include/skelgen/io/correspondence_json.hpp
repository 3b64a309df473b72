#pragma once

#include <string>
#include <utility>
#include <vector>

#include <skelgen/applications/correspondence.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/io/skeleton_json.hpp>

namespace skelgen::io {

/// A place that has a name, as a vertex of each of two bodies.
struct NamedPair {
    std::string name;
    int from = 0, to = 0;
};

/// Which place of one body is which of another one.
struct CorrespondenceFile {
    SourceMesh from, to;
    Quality from_quality, to_quality;
    std::vector<NamedPair> landmarks;
    std::vector<int> vertex_to_vertex; ///< for each vertex of `from` one of `to`
    std::vector<double> confidence;    ///< for each vertex of `from`, 0 to 1; empty: not asked for
    /// For each vertex of `from` its place on a face of `to`; empty: not asked for.
    std::vector<applications::TrianglePlace> places = {};
};

/// A correspondence as the text of its file (data/schema/correspondence.schema.json): JSON in UTF-8. O(n).
[[nodiscard]] std::string correspondence_to_json(const CorrespondenceFile& correspondence);

} // namespace skelgen::io
