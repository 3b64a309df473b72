#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::synth {

/// One tube: the balls (or ellipses) along a line. Where it starts or ends in a point of another tube's line, the two
/// are joined there; elsewhere its ends are capped by half a ball (half an ellipsoid as long as the tube is thin).
struct TubeStroke {
    std::vector<Vector3<double>> line; ///< at least two points, a quarter of the radius apart or closer; the first one
                                       ///< once more at the end closes a ring
    std::vector<double> radii;         ///< one per point: half the smaller diameter there
    std::vector<Vector3<double>> wide; ///< one per point: unit direction of the larger diameter; none: round sections
    double aspect = 1;                 ///< larger over smaller diameter
    double blend = 0;                  ///< length within which its surface flows into that of the tubes before it
};

/// A thing of tubes whose curve skeleton is known by construction.
struct TubePlan {
    std::string name; ///< of its files
    std::vector<TubeStroke> strokes;
    int faces = 8000;  ///< that show every tube
    int ends = 2;      ///< of the axis
    int cycles = 0;    ///< of the axis, and handles of the surface
    bool fine = false; ///< has branches that are short for their thickness: to be found at the finest detail alone
};

/// What there is to be made: straight, bent, tapering and winding tubes, rings and a knot, branchings, trees, stars,
/// ladders, elliptical sections, an animal and a hand; sizes about 2, each turned and moved at random. The same seed
/// gives the same plans.
[[nodiscard]] std::vector<TubePlan> tube_plans(std::uint64_t seed);

/// A mesh of tubes and the axis in it.
struct SynthTube {
    TriangleMesh<double> mesh;
    CurveSkeleton<double> truth; ///< the lines of the tubes, each free end carried on to the pole of its cap
};

/// A closed mesh in one piece with `faces` triangles (within 2 %), `least_faces` to `most_faces`, smaller ones on
/// thinner tubes. The same arguments give the same bytes. Seconds for 8000 faces.
/// \throws Error usage when `faces` is out of its range, internal when the ends or cycles of the axis or the handles of
/// the mesh are not those planned.
[[nodiscard]] SynthTube synthesize_tube(const TubePlan& plan, int faces);

/// JSON with mesh, source, axis ({"nodes", "edges", "radii"}), and the numbers of ends and cycles.
/// \param mesh_file what to write into "mesh"
[[nodiscard]] std::string curve_truth_to_json(const CurveSkeleton<double>& truth, const std::string& mesh_file);

} // namespace skelgen::synth
