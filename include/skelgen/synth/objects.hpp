#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::synth {

/// The things that `synthesize_object` knows, none of them one human body: a dog, furniture, single parts of a body,
/// two people, a sphere, a torus.
[[nodiscard]] std::vector<std::string> object_names();

/// A watertight, manifold mesh in metres, z up, with `faces` triangles (within 2 %), `least_faces` to `most_faces`. The
/// same arguments give the same bytes. Seconds for 14K faces.
/// \throws Error usage when the name is not known or `faces` out of its range.
[[nodiscard]] TriangleMesh<double> synthesize_object(std::string_view name, int faces);

/// JSON that says that there is no skeleton to be found: mesh, source and "not_a_body".
/// \param mesh_file what to write into "mesh"
[[nodiscard]] std::string object_truth_to_json(const std::string& mesh_file);

} // namespace skelgen::synth
