#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace skelgen::regression {

/// How the extraction does on one set.
struct SetResult {
    std::size_t meshes = 0;
    std::map<std::string, std::size_t> counts; ///< of meshes: "solved", "sides" (right); of objects: "refused"; of
                                               ///< tubes: "ends", "cycles" (right), "near" (the axis, everywhere);
                                               ///< of hands: "counted", "thumbs", "told" (`HandScores`)
    std::map<std::string, double> joints;      ///< mean error over the solved meshes, in geodesic diameters
    std::optional<double> axis;                ///< of tubes: mean distance of curve and axis, in local radii
    std::optional<double> digits;              ///< of hands: median error of the digits' joints, geodesic diameters
};

using Results = std::map<std::string, SetResult>;

/// How far a result may fall behind the expected one.
struct Tolerances {
    std::size_t count = 0;       ///< meshes
    double joint_error = 0.0;    ///< geodesic diameters
    double axis_error = 0.01;    ///< local radii
    double digit_error = 0.0002; ///< geodesic diameters
};

struct Expectations {
    Tolerances tolerances;
    Results sets;
};

/// Extracts the skeletons of all meshes that `make_bodies` has put into the folder (into FOLDER/skeletons) and scores
/// them; finds the curves of the tubes, and says in FOLDER/tubes/scores.txt how each of them does.
[[nodiscard]] Results measure(const std::filesystem::path& folder, unsigned jobs);

/// \throws Error bad_input when the file cannot be read or is no such JSON.
[[nodiscard]] Expectations read_expectations(const std::filesystem::path& file);
void write_expectations(const std::filesystem::path& file, const Expectations& expectations);

/// One line per number that has moved, whichever way.
[[nodiscard]] std::vector<std::string> moves(const Results& before, const Results& after);

/// One line per number that is worse than expected by more than the tolerance, and per set or joint that is missing.
/// Joints are compared in sets of which as many meshes are solved as expected.
[[nodiscard]] std::vector<std::string> regressions(const Expectations& expected, const Results& found);

/// A table of the counts and mean errors: of joints in geodesic diameters, of the tubes in local radii.
[[nodiscard]] std::string to_table(const Results& results);

} // namespace skelgen::regression
