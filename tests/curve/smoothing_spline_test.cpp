#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/impl/smoothing_spline.hpp>

#include "catch.hpp"
#include "curve/branched_lines.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

constexpr double spacing = 0.05, thickness = 0.2;

using Sections = std::vector<std::vector<BranchSection<double>>>;

BranchSection<double> section_at(const Vec3& centre, const Vec3& normal, double weight) {
    BranchSection<double> section;
    section.centre = centre;
    section.normal = normal;
    section.thickness = thickness;
    section.weight = weight;
    return section;
}

/// A bar along x and a stem along y; the knot, at (0, 0.2, 0), is not where they meet.
BranchedCurve<double> bent_tee() {
    return straight_branches({{0, 0.2, 0}, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1}, {0, 2}, {0, 3}}, spacing);
}

/// Sections with their centres on the tee's axes; those nearer to the junction than `blind` do not count.
Sections sections_of(const BranchedCurve<double>& tee, double blind) {
    Sections out(tee.branches.size());
    for (std::size_t b = 0; b < out.size(); ++b)
        for (Eigen::Index i = 0; i < tee.branches[b].line.rows(); ++i) {
            const Vec3 place = point(tee.branches[b].line, i), along = b == 2 ? Vec3::UnitY() : Vec3::UnitX();
            const bool inner = i > 0 && i + 1 < tee.branches[b].line.rows();
            out[b].push_back(section_at(place.dot(along) * along, along, inner && place.norm() > blind ? 1.0 : 0.0));
        }
    return out;
}

double straightness(const BranchedCurve<double>& tee) {
    double most = 0;
    for (std::size_t b = 0; b < 2; ++b)
        for (Eigen::Index i = 0; i < tee.branches[b].line.rows(); ++i)
            most = std::max(most, std::abs(tee.branches[b].line(i, 1)));
    return most;
}

} // namespace

TEST_CASE("a junction near which no section counts comes to where it is drawn, and its branches go straight there") {
    BranchedCurve<double> tee = bent_tee();
    PlacesOfKnots<double> junctions(tee.knots.size());
    junctions[0] = Vec3(Vec3::Zero());
    for (int round = 0; round < 5; ++round) {
        const Sections sections = sections_of(tee, 0.3);
        tee = smoothing_spline(std::move(tee), sections, {}, junctions, 0.4);
    }
    CHECK(tee.knots[0].norm() < 0.01);
    CHECK(straightness(tee) < 0.01);
    for (const Branch<double>& branch : tee.branches)
        CHECK(point(branch.line, 0) == tee.knots[static_cast<std::size_t>(branch.from)]);
}

TEST_CASE("a spline through centres on a line is that line, whatever its stiffness") {
    const BranchedCurve<double> line = straight_branches({{0, 0, 0}, {0, 0, 2}}, {{0, 1}}, spacing);
    Sections sections(1);
    for (Eigen::Index i = 0; i < line.branches[0].line.rows(); ++i)
        sections[0].push_back(section_at(point(line.branches[0].line, i), Vec3::UnitZ(), 1));
    for (const double stiffness : {0.0, 0.4, 5.0}) {
        const BranchedCurve<double> after = smoothing_spline(line, sections, {}, {}, stiffness);
        CHECK((after.branches[0].line - line.branches[0].line).cwiseAbs().maxCoeff() < 1e-9);
    }
}

TEST_CASE("a stiffer spline follows a zigzag of centres less") {
    const BranchedCurve<double> line = straight_branches({{0, 0, 0}, {0, 0, 2}}, {{0, 1}}, spacing);
    Sections sections(1);
    for (Eigen::Index i = 0; i < line.branches[0].line.rows(); ++i) {
        const Vec3 side(i % 2 == 0 ? 0.05 : -0.05, 0, 0);
        sections[0].push_back(section_at(point(line.branches[0].line, i) + side, Vec3::UnitZ(), 1));
    }
    double last = 0.05;
    for (const double stiffness : {0.1, 0.4, 1.0}) {
        const Points<double> after = smoothing_spline(line, sections, {}, {}, stiffness).branches[0].line;
        const double most = after.middleRows(8, after.rows() - 16).col(0).cwiseAbs().maxCoeff();
        CHECK(most < last);
        last = most;
    }
    CHECK(last < 0.005);
}
