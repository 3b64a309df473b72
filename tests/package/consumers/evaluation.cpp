// A user's program that links skelgen::evaluation alone: a skeleton scored against itself.

#include <cstdlib>

#include <skelgen/evaluation/evaluate.hpp>

int main() {
    skelgen::io::GroundTruth truth;
    skelgen::evaluation::JointPositions joints;
    double x = 0;
    for (const auto& name : skelgen::evaluation::evaluated_joints()) {
        const skelgen::Vector3<double> place(x += 0.5, 0, 0);
        joints[name] = place;
        truth.joints.emplace_back(name, place);
        truth.markers[name] = place;
    }
    const auto score = skelgen::evaluation::score_joints(truth, joints);
    return score.complete && score.sides && score.errors.front().second == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
