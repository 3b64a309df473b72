#include "held_things.hpp"

#include <algorithm>
#include <sstream>

#include <skelgen/core/error.hpp>
#include <skelgen/surface/manifold_parts.hpp>

#include "surface_mesher.hpp"

namespace skelgen::synth {
namespace {

void check_hand_field(const char* field, double value, double low, double high, const char* unit) {
    if (value >= low && value <= high) return;
    std::ostringstream what;
    what << "a hand's " << field << " of " << value << " is out of range: give " << low << " to " << high << unit;
    throw Error(ErrorCode::usage, what.str());
}

} // namespace

void check_hand(const HandShape& hand) {
    check_hand_field("number of digits", hand.digits, 2, 5, "");
    check_hand_field("glove", hand.glove, 0, 0.006, " m");
    for (const DigitShape& digit : hand.digit) {
        check_hand_field("curl", digit.curl, -10, 90, " degrees");
        check_hand_field("spread", digit.spread, -5, 15, " degrees");
    }
}

TriangleMesh<double> with_held_things(TriangleMesh<double> mesh, const ImplicitBody& field, const BodyPlan& plan,
                                      double ground) {
    constexpr int faces = 800;
    for (const auto& [name, cone] : field.held()) {
        const BodyJoint wrist = name == PartName::left_hand ? BodyJoint::left_wrist : BodyJoint::right_wrist;
        if (std::find(plan.missing.begin(), plan.missing.end(), wrist) != plan.missing.end()) continue;
        const Part& hand = field.part(name);
        const RoundCone thing{hand.to_world(cone.from), hand.to_world(cone.to), cone.from_radius, cone.to_radius};
        const double reach = (thing.to - thing.from).norm() / 2 + 2 * thing.from_radius;
        TriangleMesh<double> piece =
            mesh_surface({thing, [](const Vec3&) { return 1.0; }, (thing.from + thing.to) / 2, reach}, faces, true);
        piece.vertices.col(2).array() -= ground;
        mesh = surface::side_by_side(mesh, piece);
    }
    return mesh;
}

} // namespace skelgen::synth
