#include <skelgen/io/coloured_ply.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <skelgen/applications/segmentation.hpp>
#include <skelgen/core/error.hpp>

#include "catch.hpp"

using namespace skelgen;

namespace {

/// CIE 1976 L*a*b* of an sRGB colour, white D65.
Eigen::Vector3d lab(const io::ByteColour& colour) {
    Eigen::Vector3d light;
    for (int i = 0; i < 3; ++i) {
        const double shown = colour[static_cast<std::size_t>(i)] / 255.0;
        light[i] = shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
    }
    Eigen::Matrix3d to_xyz;
    to_xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
    const Eigen::Vector3d xyz = (to_xyz * light).array() / Eigen::Array3d(0.95047, 1, 1.08883);
    const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    return {116 * f(xyz[1]) - 16, 500 * (f(xyz[0]) - f(xyz[1])), 200 * (f(xyz[1]) - f(xyz[2]))};
}

} // namespace

TEST_CASE("part colours: any two parts of a set can be told apart", "[io]") {
    const auto set = GENERATE(applications::PartSet::bones, applications::PartSet::body);
    for (const BodyKind plan : {BodyKind::human, BodyKind::quadruped}) {
        const std::vector<std::string> names = applications::part_names(set, plan);
        const std::vector<io::ByteColour> colours = io::part_colours(names);
        REQUIRE(colours.size() == names.size());
        for (std::size_t a = 0; a < names.size(); ++a)
            for (std::size_t b = 0; b < a; ++b) {
                INFO(names[a] << " and " << names[b]);
                CHECK((lab(colours[a]) - lab(colours[b])).norm() > 25); // 2.3 can just be told apart
            }
    }
    CHECK_THROWS_AS(io::part_colours({"wing"}), Error);
}
