#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skelgen::regression {

/// A part of a synthetic set: every `stride`-th body of it.
struct SetSample {
    std::string set;
    std::size_t stride = 1;
};

/// What the regression looks at: easy sets and hard ones.
[[nodiscard]] const std::vector<SetSample>& body_samples();

/// The set of animals.
inline constexpr const char* quadruped_set = "quadrupeds";

/// Makes the samples, the animals and the set of things that are no body: FOLDER/meshes/<set>/<name>.off,
/// FOLDER/truth/<set>/<name>.json; and the tubes, in FOLDER/tubes. What was there before goes.
void make_bodies(const std::filesystem::path& folder, unsigned jobs);

/// Whether `make_bodies` has come to its end in this folder.
[[nodiscard]] bool has_bodies(const std::filesystem::path& folder);

} // namespace skelgen::regression
