// A user's program that links skelgen::synth alone: a body of 5000 faces, with its true joints.

#include <cstdlib>

#include <skelgen/synth/body.hpp>

int main() {
    const skelgen::synth::BodyShape adult;
    const auto pose = skelgen::synth::spread_limbs(adult, skelgen::synth::named_pose("a"));
    const auto body = skelgen::synth::synthesize_body(adult, pose, skelgen::synth::least_faces);
    const double faces = static_cast<double>(body.mesh.faces.rows());
    return faces > 4000 && faces < 6000 && body.truth.geodesic_diameter > 1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
