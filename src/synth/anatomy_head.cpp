#include "anatomy.hpp"

namespace skelgen::synth {
namespace {

Mat3 turned(double angle, const Vec3& axis) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

void add_half_face(std::vector<Blob>& blobs, const Proportions& p, double side) {
    const double h = p.head_scale, cheek = 1 + 0.5 * p.fat, jaw = 0.92 + 0.10 * p.masculinity * p.maturity;
    const auto at = [&](double x, double y, double z) -> Vec3 { return h * Vec3(side * x, y, z); };
    blobs.push_back(
        {RoundCone{at(0.045, -0.020, -0.020), at(0.018, -0.082, -0.048), 0.015 * h * jaw, 0.014 * h * jaw}, 0.034 * h});
    blobs.push_back({Ellipsoid{at(0.042, -0.072, -0.002), h * Vec3(0.021, 0.023, 0.022) * cheek}, 0.024 * h});
    blobs.push_back({RoundCone{at(0.008, -0.100, 0.044), at(0.048, -0.082, 0.046), 0.009 * h, 0.010 * h}, 0.014 * h});
    blobs.push_back({Ellipsoid{at(0.031, -0.118, 0.026), h * Vec3(0.017, 0.020, 0.010)}, 0.012 * h, Use::carve});
    blobs.push_back({Ellipsoid{at(0.031, -0.086, 0.026), h * Vec3(0.013, 0.013, 0.012)}, 0.003 * h});
    blobs.push_back({Ellipsoid{at(0.010, -0.114, -0.010), h * Vec3(0.008, 0.010, 0.008)}, 0.006 * h});
    // The ear: a tilted disc, hollowed in front.
    const Mat3 flap = turned(side * 0.45, Vec3::UnitZ()) * turned(-0.2, Vec3::UnitX());
    blobs.push_back({Ellipsoid{at(0.071, 0.012, 0.016), h * Vec3(0.0075, 0.018, 0.031), flap}, 0.010 * h});
    blobs.push_back({Ellipsoid{at(0.080, 0.007, 0.018), h * Vec3(0.006, 0.009, 0.017), flap}, 0.004 * h, Use::carve});
}

} // namespace

std::vector<Blob> head(const Proportions& p) {
    const double h = p.head_scale;
    const auto at = [h](double x, double y, double z) -> Vec3 { return h * Vec3(x, y, z); };
    const double young = 1 - p.maturity;
    std::vector<Blob> blobs{{Ellipsoid{at(0, -0.010, 0.072), h * Vec3(0.076, 0.096, 0.093)}, 0}};
    blobs.push_back({Ellipsoid{at(0, -0.058, 0.010), h * Vec3(0.058, 0.052, 0.066)}, 0.03 * h});
    for (const double side : {1.0, -1.0}) add_half_face(blobs, p, side);
    blobs.push_back({Ellipsoid{at(0, -0.092, -0.046), h * Vec3(0.024, 0.019, 0.018) * (1 - 0.1 * young)}, 0.016 * h});
    const double nose = 1 - 0.25 * young;
    blobs.push_back(
        {RoundCone{at(0, -0.103, 0.036), at(0, -0.114 - 0.012 * nose, -0.003), 0.007 * h, 0.0105 * h}, 0.010 * h});
    blobs.push_back({Ellipsoid{at(0, -0.106, -0.023), h * Vec3(0.021, 0.010, 0.0055)}, 0.004 * h});
    blobs.push_back({Ellipsoid{at(0, -0.104, -0.034), h * Vec3(0.019, 0.011, 0.0060)}, 0.004 * h});
    // The floor of the mouth and the nape join the skull to the neck.
    blobs.push_back({RoundCone{at(0, -0.030, -0.020), at(0, 0.018, 0.020), 0.048 * h, 0.058 * h}, 0.02 * h});
    return blobs;
}

std::vector<Blob> mouth(const Proportions& p) {
    const double h = p.head_scale, deep = p.mouth;
    const auto at = [h](double y, double z) -> Vec3 { return h * Vec3(0, y, z); };
    const Vec3 palate = at(std::lerp(-0.080, -0.030, deep), -0.020);
    std::vector<Blob> blobs{{Ellipsoid{at(-0.105, -0.029), h * Vec3(0.019, 0.030, 0.007)}, 0}};
    blobs.push_back({RoundCone{at(-0.080, -0.029), palate, 0.014 * h, 0.023 * h}, 0.004 * h});
    const double throat = std::max(0.0, deep - 0.5); // goes down behind the tongue
    if (throat > 0)
        blobs.push_back(
            {RoundCone{palate, palate + at(0.05 * throat, -0.10 * throat), 0.018 * h, 0.012 * h}, 0.004 * h});
    return blobs;
}

} // namespace skelgen::synth
