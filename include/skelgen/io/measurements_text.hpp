#pragma once

#include <string>
#include <vector>

#include <skelgen/applications/measurement.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/io/skeleton_json.hpp>

namespace skelgen::io {

/// One body's measures and where they come from.
struct MeasuredBody {
    SourceMesh mesh;
    Quality quality;
    applications::Measurements measures;
};

/// The measures of some bodies as the text of a file (data/schema/measurements.schema.json), JSON in UTF-8. It has the
/// unit in which the body is as high as people are, and where girths were taken; what is not known is null. \throws
/// Error internal when a number is not finite.
[[nodiscard]] std::string measurements_to_json(const std::vector<MeasuredBody>& bodies);

/// The same as CSV (RFC 4180), a line for each body below one of names; what is not known is empty, file names are in
/// quotes. \throws Error internal when a number is not finite, usage when some are people and some animals.
[[nodiscard]] std::string measurements_to_csv(const std::vector<MeasuredBody>& bodies);

} // namespace skelgen::io
