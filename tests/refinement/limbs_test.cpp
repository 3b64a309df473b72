#include <skelgen/embedding/reduced_graph.hpp>
#include <skelgen/io/template_json.hpp>
#include <skelgen/refinement/limbs.hpp>

#include "catch.hpp"

using namespace skelgen;

TEST_CASE("a body twice as large has twice the scale, a template twice as large half of it") {
    const SkeletonTemplate& human = builtin_template("human21");
    SkeletonTemplate large = human;
    for (TemplateJoint& joint : large.joints) {
        joint.position *= 2;
        if (joint.tip) *joint.tip *= 2;
    }
    const double scale = template_scale(human, 2.0);
    CHECK(scale > 0);
    CHECK(template_scale(human, 4.0) == Approx(2 * scale));
    CHECK(template_scale(large, 2.0) == Approx(scale / 2));
}

TEST_CASE("over the surface it is a little shorter from toe to fingertip than along the bones") {
    for (const char* name : {"human21", "pinocchio18"}) {
        const SkeletonTemplate& human = builtin_template(name);
        const double scale = template_scale(human, longest_path(human));
        CHECK(scale >= 1);
        CHECK(scale < 1.2);
    }
}
