#include <stdexcept>
#include <string>
#include <utility>

#include <skelgen/refinement/impl/bare_joints.hpp>

#include "catch.hpp"
#include "refinement/stick_figure.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

/// human21 at rest without what follows a joint, all joints placed but that one.
double error_of(const std::string& joint, const std::string& first_absent) {
    const SkeletonTemplate& human = builtin_template("human21");
    const auto index = [&](const std::string& name) {
        for (std::size_t j = 0; j < human.joints.size(); ++j)
            if (human.joints[j].name == name) return static_cast<int>(j);
        throw std::runtime_error("no joint " + name);
    };
    const SkeletonTemplate part = without_limb(human, index(first_absent));
    const StickFigure<double> figure;
    Placement<double> placement(part, 1);
    for (int j = 0; j < static_cast<int>(part.joints.size()); ++j)
        if (j != index(joint)) placement.put(j, part.joint(j).position);
    placement = place_bare_joints(std::move(placement), figure.curve, figure.embedding);
    for (int j = 0; j < static_cast<int>(part.joints.size()); ++j)
        if (j != index(joint)) CHECK(placement.at(j) == part.joint(j).position);
    return (placement.at(index(joint)) - human.joint(index(joint)).position).norm();
}

} // namespace

TEST_CASE("what is left of a limb lies where the other side's would be mirrored, a neck above the shoulders") {
    CHECK(error_of("left_shoulder", "left_elbow") < 0.02); // metres: the spine lies behind the hips
    CHECK(error_of("right_hip", "right_knee") < 0.02);
    CHECK(error_of("neck", "head") < 0.02);
}

TEST_CASE("a whole body has no joints of that kind") {
    const SkeletonTemplate& human = builtin_template("human21");
    const StickFigure<double> figure;
    Placement<double> placement(human, 1);
    placement = place_bare_joints(std::move(placement), figure.curve, figure.embedding);
    CHECK(placement.positions().isZero());
}
