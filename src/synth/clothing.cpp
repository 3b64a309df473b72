#include "clothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <skelgen/core/error.hpp>

#include "anatomy.hpp"
#include "lines.hpp"

namespace skelgen::synth {
namespace {

constexpr std::array<std::pair<std::string_view, Garment>, 22> garments{{{"axe", Garment::axe},
                                                                         {"boots", Garment::boots},
                                                                         {"bow", Garment::bow},
                                                                         {"bun", Garment::bun},
                                                                         {"cape", Garment::cape},
                                                                         {"coat", Garment::coat},
                                                                         {"hat", Garment::hat},
                                                                         {"helmet", Garment::helmet},
                                                                         {"horns", Garment::horns},
                                                                         {"long-hair", Garment::long_hair},
                                                                         {"long-pony-tail", Garment::long_pony_tail},
                                                                         {"mittens", Garment::mittens},
                                                                         {"pony-tail", Garment::pony_tail},
                                                                         {"rucksack", Garment::rucksack},
                                                                         {"shield", Garment::shield},
                                                                         {"skirt", Garment::skirt},
                                                                         {"staff", Garment::staff},
                                                                         {"sword", Garment::sword},
                                                                         {"tail", Garment::tail},
                                                                         {"trousers", Garment::trousers},
                                                                         {"wide-skirt", Garment::wide_skirt},
                                                                         {"wings", Garment::wings}}};

} // namespace

std::vector<std::string> garment_names() {
    std::vector<std::string> names;
    for (const auto& [name, garment] : garments) names.emplace_back(name);
    return names;
}

Garment named_garment(std::string_view name) {
    for (const auto& [known, garment] : garments)
        if (name == known) return garment;
    std::string what = "there is no garment " + std::string(name) + ": give one of";
    for (const std::string& known : garment_names()) what += " " + known;
    throw Error(ErrorCode::usage, what);
}

namespace {

constexpr std::array<PartName, 2> upper_arms{PartName::left_upper_arm, PartName::right_upper_arm};
constexpr std::array<PartName, 2> thighs{PartName::left_thigh, PartName::right_thigh};

Blob cut_above(double z) { return {HalfSpace{Vec3::UnitZ(), z}, 0.004, Use::keep}; }
Blob cut_below(double z) { return {HalfSpace{-Vec3::UnitZ(), -z}, 0.004, Use::keep}; }

/// A cover of all that bulges out of the blobs, `ease` away from it.
std::vector<Blob> cover(const std::vector<Blob>& blobs, double ease) {
    std::vector<Blob> result;
    for (const Blob& blob : blobs)
        if (blob.use == Use::add) result.push_back(grown(blob, ease));
    return result;
}

/// A round sleeve or leg around a limb from one fraction of its bone to another, as wide as given (metres over the
/// limb's mean radius) at either end.
Blob sleeve(const Part& limb, double from, double to, double wide_from, double wide_to) {
    const Tube& body = outline(limb.blobs);
    std::vector<Ring> rings;
    constexpr int pieces = 6;
    for (int i = 0; i <= pieces; ++i) {
        const double u = static_cast<double>(i) / pieces;
        Ring ring = body.ring(limb.length * std::lerp(from, to, u));
        ring.at = limb.length * std::lerp(from, to, u);
        ring.side = ring.front = ring.back = (ring.side + ring.front) / 2 + std::lerp(wide_from, wide_to, u);
        rings.push_back(ring);
    }
    return {Tube(std::move(rings), 2, 0.03, 0.012), 0};
}

/// Around the hips, from below up to the waist.
void cover_hips(ImplicitBody& body, double ease) {
    std::vector<Blob> layer = cover(body.part(PartName::trunk).blobs, ease);
    layer.push_back(cut_above(body.skeleton().rest_position(BodyJoint::waist).z()));
    body.wear(PartName::trunk, std::move(layer), ease);
}

void put_on_trousers(ImplicitBody& body, double k) {
    cover_hips(body, 0.012 * k);
    for (const PartName thigh : thighs) {
        body.wear(thigh, {sleeve(body.part(thigh), 0, 1, 0.012 * k, 0.020 * k)}, 0.03 * k);
        const PartName calf = next(thigh, 1);
        body.wear(calf, {sleeve(body.part(calf), 0, 0.97, 0.020 * k, 0.042 * k)}, 0.05 * k);
    }
}

void put_on_boots(ImplicitBody& body, const Proportions& p) {
    const double k = p.foot_scale, sole = -p.ankle_height;
    for (const PartName thigh : thighs) {
        const PartName calf = next(thigh, 1), foot = next(thigh, 2);
        body.wear(calf, {sleeve(body.part(calf), 0.42, 1, 0.016 * k, 0.016 * k)}, 0.03 * k);
        std::vector<Blob> boot = cover(body.part(foot).blobs, 0.010 * k);
        boot.push_back({RoundCone{Vec3(-0.018 * k, -0.148 * k, sole + 0.022 * k),
                                  Vec3(0.022 * k, -0.132 * k, sole + 0.020 * k), 0.030 * k, 0.028 * k},
                        0.02 * k});
        boot.push_back(
            {RoundCone{Vec3(0, 0.022 * k, sole), Vec3(0, 0.026 * k, sole + 0.05 * k), 0.040 * k, 0.042 * k}, 0.02 * k});
        boot.push_back(cut_below(sole - 0.022 * k));
        body.wear(foot, std::move(boot), 0.04 * k);
    }
}

/// What hangs from the hips around both legs, down to a fraction of the thighs, `ease` wider than they.
void add_skirt(ImplicitBody& body, double length, double ease, double flare) {
    const PosedSkeleton& s = body.skeleton();
    const auto at = [&s](BodyJoint joint) { return s.position(joint); };
    const Part& thigh = body.part(PartName::left_thigh);
    const Tube& leg = outline(thigh.blobs);
    const double top = leg.ring(0.1 * thigh.length).side + ease, bottom = leg.ring(length * thigh.length).side + flare;
    const Vec3 left = at(BodyJoint::left_hip) + length * (at(BodyJoint::left_knee) - at(BodyJoint::left_hip));
    const Vec3 right = at(BodyJoint::right_hip) + length * (at(BodyJoint::right_knee) - at(BodyJoint::right_hip));
    std::vector<Blob> cloth;
    constexpr int folds = 8;
    for (int i = 0; i <= folds; ++i) {
        const double u = static_cast<double>(i) / folds;
        const Vec3 from = at(BodyJoint::left_hip) + u * (at(BodyJoint::right_hip) - at(BodyJoint::left_hip));
        cloth.push_back({RoundCone{from, left + u * (right - left), top, bottom}, 0.02});
    }
    const Vec3 down = ((left + right) / 2 - (at(BodyJoint::left_hip) + at(BodyJoint::right_hip)) / 2).normalized();
    const double lowest = std::max(down.dot(left), down.dot(right));
    cloth.push_back({HalfSpace{down, lowest}, 0.008, Use::keep});
    body.carry(Eigen::Isometry3d::Identity(), std::move(cloth));
}

void put_on_coat(ImplicitBody& body, double k) {
    for (const PartName upper : upper_arms) {
        body.wear(upper, cover(body.part(upper).blobs, 0.016 * k), 0.016 * k);
        const PartName fore = next(upper, 1);
        body.wear(fore, {sleeve(body.part(fore), 0, 0.93, 0.016 * k, 0.022 * k)}, 0.03 * k);
    }
    std::vector<Blob> layer = cover(body.part(PartName::trunk).blobs, 0.020 * k);
    layer.push_back(cut_above(body.skeleton().rest_position(BodyJoint::neck).z() - 0.01 * k));
    body.wear(PartName::trunk, std::move(layer), 0.020 * k);
    add_skirt(body, 0.95, 0.026 * k, 0.050 * k);
}

void put_on_hat(ImplicitBody& body, const Proportions& p) {
    const double h = p.head_scale;
    const auto ring = [h](double at, double side, double front, double back) {
        return Ring{at * h, side * h, front * h, back * h};
    };
    std::vector<Blob> hat{
        {Tube({ring(0.085, 0.086, 0.112, 0.096), ring(0.140, 0.083, 0.108, 0.090), ring(0.195, 0.072, 0.092, 0.078)}, 2,
              0.01 * h, 0.018 * h),
         0}};
    hat.push_back({Ellipsoid{Vec3(0, -0.008 * h, 0.090 * h), h * Vec3(0.165, 0.185, 0.013)}, 0.008 * h});
    body.wear(PartName::head, std::move(hat), 0.09 * h);
}

/// A lock from the scalp over nape and shoulders onto the back, at an angle (radians) about the head from its back to
/// the left; the locks between others are shorter.
void add_strand(std::vector<Blob>& strands, const ImplicitBody& body, const Proportions& p, double angle,
                bool is_long) {
    const double h = p.head_scale, k = p.scale, side = std::sin(angle), back = std::cos(angle);
    const PosedSkeleton& s = body.skeleton();
    const double chest = s.rest_position(BodyJoint::chest).z(), neck = s.rest_position(BodyJoint::neck).z();
    const auto scalp = [&](double wide, double deep, double z) -> Vec3 {
        return body.part(PartName::head).frame * (h * Vec3(wide * side, 0.012 + deep * back, z));
    };
    const auto trunk = [&](double wide, double deep, double z) {
        return body.trunk_to_world({wide * k * side, (0.02 + deep * back) * k, z});
    };
    const std::array<Vec3, 5> path{
        scalp(0.060, 0.066, 0.050), scalp(0.068, 0.058, -0.040), trunk(0.080, 0.052, neck - 0.01 * k),
        body.onto_trunk(trunk(0.105, 0.110, chest + 0.150 * k)),
        body.onto_trunk(trunk(0.095, 0.125, chest + (is_long ? 0.040 : 0.075) * k + 0.03 * k * std::abs(side)))};
    const std::array<double, 5> radii{0.030 * h, 0.031 * h, 0.030 * k, 0.024 * k, 0.011 * k};
    for (std::size_t i = 1; i < path.size(); ++i)
        strands.push_back({RoundCone{path[i - 1], path[i], radii[i - 1], radii[i]}, 0.010 * k});
}

/// Around skull and nape, the face left free.
std::vector<Blob> hair_on_head(double h) {
    std::vector<Blob> hair{{Ellipsoid{Vec3(0, -0.004 * h, 0.078 * h), h * Vec3(0.090, 0.108, 0.100)}, 0}};
    hair.push_back({Ellipsoid{Vec3(0, 0.03 * h, 0.01 * h), h * Vec3(0.086, 0.080, 0.090)}, 0.02 * h});
    hair.push_back({Ellipsoid{Vec3(0, -0.125 * h, 0.0), h * Vec3(0.075, 0.085, 0.110)}, 0.02 * h, Use::carve});
    return hair;
}

void put_on_long_hair(ImplicitBody& body, const Proportions& p) {
    body.wear(PartName::head, hair_on_head(p.head_scale), 0.03 * p.head_scale);

    std::vector<Blob> strands;
    constexpr int count = 7;
    for (int i = 0; i < count; ++i) add_strand(strands, body, p, std::lerp(-1.25, 1.25, i / (count - 1.0)), i % 2 == 0);
    body.carry(Eigen::Isometry3d::Identity(), std::move(strands));
}

/// Over the shoulder, down the chest and back below the arm, on the surface of the trunk and what covers it.
void add_strap(std::vector<Blob>& straps, const ImplicitBody& body, double k, double side) {
    const Vec3 chest = body.skeleton().rest_position(BodyJoint::chest);
    constexpr std::array<std::array<double, 3>, 7> path{{{.090, .150, .120},
                                                         {.102, .100, .165},
                                                         {.106, .025, .182},
                                                         {.106, -.050, .158},
                                                         {.108, -.110, .095},
                                                         {.135, -.080, -.030},
                                                         {.130, .120, -.130}}};
    const auto knot = [&](std::size_t i) -> Vec3 {
        return chest + k * Vec3(side * path[i][0], path[i][1], path[i][2]);
    };
    constexpr int pieces = 5; // per leg of the path: a longer one would cut through the body
    Vec3 last = body.onto_trunk(body.trunk_to_world(knot(0)));
    for (std::size_t i = 1; i < path.size(); ++i)
        for (int piece = 1; piece <= pieces; ++piece) {
            const double u = static_cast<double>(piece) / pieces;
            const Vec3 next = body.onto_trunk(body.trunk_to_world((1 - u) * knot(i - 1) + u * knot(i)));
            straps.push_back({RoundCone{last, next, 0.021 * k, 0.021 * k}, 0.004 * k});
            last = next;
        }
}

void put_on_rucksack(ImplicitBody& body, const Proportions& p) {
    const double k = p.scale, back = (0.165 + 0.07 * std::max(0.0, p.fat)) * k;
    const auto ring = [k](double at, double side, double depth) {
        return Ring{at * k, side * k, depth * k, depth * k};
    };
    const Eigen::Isometry3d chest = body.skeleton().frame(BodyJoint::chest);
    const Eigen::Isometry3d bag = chest * Eigen::Translation3d(0, back + 0.02 * k, 0.11 * k);
    body.carry(bag, {{Tube({ring(-0.30, 0.145, 0.080), ring(-0.18, 0.160, 0.095), ring(0.04, 0.140, 0.080)}, 5,
                           0.02 * k, 0.03 * k),
                      0}});

    std::vector<Blob> straps;
    for (const double side : {1.0, -1.0}) add_strap(straps, body, k, side);
    body.carry(Eigen::Isometry3d::Identity(), std::move(straps));
}

/// A chain of rounded cones through the points.
std::vector<Blob> chain(const std::vector<Vec3>& path, const std::vector<double>& radii, double blend) {
    std::vector<Blob> blobs;
    for (std::size_t i = 1; i < path.size(); ++i)
        blobs.push_back({RoundCone{path[i - 1], path[i], radii[i - 1], radii[i]}, blend});
    return blobs;
}

/// Likewise, in pieces of this length at most: blobs are bounded by balls, small ones for short pieces.
std::vector<Blob> fine_chain(const std::vector<Vec3>& path, const std::vector<double>& radii, double longest,
                             double blend) {
    std::vector<Vec3> fine_path{path.front()};
    std::vector<double> fine_radii{radii.front()};
    for (std::size_t i = 1; i < path.size(); ++i) {
        const int pieces = static_cast<int>(std::ceil((path[i] - path[i - 1]).norm() / longest));
        for (int piece = 1; piece <= pieces; ++piece) {
            const double u = static_cast<double>(piece) / pieces;
            fine_path.emplace_back((1 - u) * path[i - 1] + u * path[i]);
            fine_radii.push_back(std::lerp(radii[i - 1], radii[i], u));
        }
    }
    return chain(fine_path, fine_radii, blend);
}

/// How far behind a point of the spine what hangs down is clear of a standing body, metres.
double behind_body(const Proportions& p) { return (0.20 + 0.12 * std::max(0.0, p.fat)) * p.scale; }

void put_on_bun(ImplicitBody& body, double h) {
    std::vector<Blob> hair = hair_on_head(h);
    hair.push_back({Ellipsoid{Vec3(0, 0.100 * h, 0.145 * h), h * Vec3(0.050, 0.045, 0.045)}, 0.008 * h});
    body.wear(PartName::head, std::move(hair), 0.12 * h);
}

/// From the back of the head straight down to a joint's height.
void put_on_pony_tail(ImplicitBody& body, const Proportions& p, BodyJoint lowest) {
    const double h = p.head_scale, k = p.scale;
    const PosedSkeleton& s = body.skeleton();
    body.wear(PartName::head, hair_on_head(h), 0.03 * h);
    const Part& head = body.part(PartName::head);
    const Vec3 root = head.to_world(h * Vec3(0, 0.075, 0.135)), out = head.to_world(h * Vec3(0, 0.150, 0.140));
    const double behind = std::max(out.y() + 0.02 * h, s.position(BodyJoint::waist).y() + behind_body(p));
    const double low = s.position(lowest).z() + 0.05 * k, top = out.z() - 0.12 * h;
    const std::vector<Vec3> path{
        root, out, {out.x(), behind, top}, {out.x(), behind, std::lerp(top, low, 0.5)}, {out.x(), behind, low}};
    body.carry(Eigen::Isometry3d::Identity(),
               fine_chain(path, {0.026 * h, 0.034 * h, 0.040 * h, 0.038 * h, 0.016 * h}, 0.15 * k, 0.010 * h));
}

void put_on_helmet(ImplicitBody& body, double h) {
    std::vector<Blob> helmet{{Ellipsoid{Vec3(0, -0.006 * h, 0.060 * h), h * Vec3(0.104, 0.126, 0.126)}, 0}};
    helmet.push_back({Ellipsoid{Vec3(0, -0.140 * h, -0.010 * h), h * Vec3(0.066, 0.075, 0.075)}, 0.01 * h, Use::carve});
    helmet.push_back(
        {RoundCone{h * Vec3(0, -0.070, 0.172), h * Vec3(0, 0.090, 0.155), 0.022 * h, 0.022 * h}, 0.01 * h});
    helmet.push_back(cut_below(-0.045 * h));
    body.wear(PartName::head, std::move(helmet), 0.10 * h);
}

/// From the sides of the skull outwards, then up.
void put_on_horns(ImplicitBody& body, double h) {
    std::vector<Blob> horns;
    for (const double side : {1.0, -1.0}) {
        const auto at = [&](double x, double y, double z) -> Vec3 { return h * Vec3(side * x, y, z); };
        const std::vector<Blob> horn =
            chain({at(0.045, -0.02, 0.125), at(0.095, -0.02, 0.165), at(0.120, -0.03, 0.220), at(0.115, -0.05, 0.275)},
                  {0.024 * h, 0.022 * h, 0.017 * h, 0.008 * h}, 0.006 * h);
        horns.insert(horns.end(), horn.begin(), horn.end());
    }
    body.wear(PartName::head, std::move(horns), 0.13 * h);
}

void put_on_mittens(ImplicitBody& body, double h) {
    for (const PartName upper : upper_arms)
        body.wear(next(upper, 2), {{Ellipsoid{h * Vec3(-0.012, -0.008, 0.088), h * Vec3(0.052, 0.072, 0.108)}, 0}},
                  0.03 * h);
}

/// From the sacrum backwards and down, its end turned up again.
void put_on_tail(ImplicitBody& body, double k) {
    const double root = body.skeleton().rest_position(BodyJoint::crotch).z();
    const Eigen::Isometry3d pelvis = body.skeleton().frame(BodyJoint::crotch);
    const auto at = [&](double back, double z) -> Vec3 { return pelvis * Vec3(0, back * k, z * k); };
    const Vec3 start = body.trunk_to_world({0, 0.06 * k, root});
    body.carry(Eigen::Isometry3d::Identity(),
               chain({start, at(0.20, -0.02), at(0.36, -0.09), at(0.50, -0.12), at(0.62, -0.06), at(0.67, 0.05)},
                     {0.048 * k, 0.042 * k, 0.036 * k, 0.031 * k, 0.026 * k, 0.020 * k}, 0.010 * k));
}

/// An oval plate across x, its rim as thick as its middle: thinner ones need finer meshes.
Blob plate(double thickness, double wide, double high) {
    std::vector<Ring> rings;
    constexpr int steps = 4;
    for (int i = -steps; i <= steps; ++i) {
        const double angle = 1.3 * i / steps, width = wide * std::cos(angle);
        rings.push_back({high * std::sin(angle), thickness / 2, width, width});
    }
    return {Tube(std::move(rings), 5, thickness / 2, thickness / 2), 0};
}

/// A large pair up and outwards, a small one below it, on short stems.
void put_on_wings(ImplicitBody& body, const Proportions& p) {
    const double k = p.scale, back = (0.130 + 0.07 * std::max(0.0, p.fat)) * k;
    const Eigen::Isometry3d chest = body.skeleton().frame(BodyJoint::chest);
    for (const double side : {1.0, -1.0}) {
        const auto add = [&](const Vec3& centre, double wide, double high, double degrees) {
            const Eigen::Quaterniond turn = Eigen::AngleAxisd(side * 0.30, Vec3::UnitZ()) *
                                            Eigen::AngleAxisd(side * degrees * pi / 180, Vec3::UnitY()) *
                                            Eigen::AngleAxisd(pi / 2, Vec3::UnitZ());
            const Vec3 middle(side * centre.x() * k, back + centre.y() * k, centre.z() * k);
            body.carry(chest * Eigen::Translation3d(middle) * turn, {plate(0.044 * k, wide * k, high * k)});
        };
        body.carry(chest, {{RoundCone{Vec3(side * 0.05 * k, back - 0.06 * k, 0.10 * k),
                                      Vec3(side * 0.16 * k, back + 0.07 * k, 0.14 * k), 0.035 * k, 0.028 * k},
                            0}});
        add({0.42, 0.15, 0.27}, 0.15, 0.37, 62);
        add({0.28, 0.11, 0.04}, 0.10, 0.21, 112);
    }
}

/// Cloth that falls from the shoulders past the buttocks, wider below.
void put_on_cape(ImplicitBody& body, const Proportions& p) {
    const double k = p.scale;
    const PosedSkeleton& s = body.skeleton();
    const Vec3 waist = s.position(BodyJoint::waist), neck = s.rest_position(BodyJoint::neck);
    const double wide = 0.75 * p.shoulder_half_width, behind = waist.y() + behind_body(p);
    const double middle = s.position(BodyJoint::crotch).z();
    const double low = std::max(s.position(BodyJoint::left_knee).z(), s.position(BodyJoint::right_knee).z());
    constexpr int folds = 14;
    std::vector<Blob> cloth;
    for (int i = 0; i <= folds; ++i) {
        const double u = 2.0 * i / folds - 1; // -1 to 1 from right to left
        const Vec3 top = body.onto_trunk(body.trunk_to_world({u * wide, 0.10 * k, neck.z() - 0.06 * k}));
        const Vec3 hip(waist.x() + 1.3 * u * wide, behind, middle),
            hem(waist.x() + 1.6 * u * wide, behind + 0.04 * k, low);
        const double radius = std::max(0.020 * k, 0.13 * wide);
        const std::vector<Blob> fold = fine_chain({top, hip, hem}, {radius, radius, radius}, 0.2 * k, 0.01 * k);
        cloth.insert(cloth.end(), fold.begin(), fold.end());
    }
    body.carry(Eigen::Isometry3d::Identity(), std::move(cloth));
}

/// A bell from the hips to the ankles, as wide as the stance needs.
void put_on_wide_skirt(ImplicitBody& body, const Proportions& p) {
    const double k = p.scale;
    const PosedSkeleton& s = body.skeleton();
    cover_hips(body, 0.010 * k);
    const Vec3 left = s.position(BodyJoint::left_ankle), right = s.position(BodyJoint::right_ankle);
    const Vec3 top = s.position(BodyJoint::crotch);
    Vec3 hem = (left + right) / 2;
    hem.z() = std::min(left.z(), right.z());
    const double waist = (0.165 + 0.10 * std::max(0.0, p.fat)) * k * p.hip_factor;
    const double stance = (left - right).norm() / 2 + 0.09 * p.limb_scale;
    const double wide = std::min(std::max(0.32 * k, stance), waist + 0.8 * (top - hem).norm());
    body.carry(Eigen::Isometry3d::Identity(),
               {{RoundCone{top, hem, waist, wide}, 0},
                {HalfSpace{-Vec3::UnitZ(), -hem.z()}, 0.01 * k, Use::keep},
                {HalfSpace{Vec3::UnitZ(), s.position(BodyJoint::waist).z()}, 0.01 * k, Use::keep}});
}

/// A disc outside of the left forearm.
void take_shield(ImplicitBody& body, const Proportions& p) {
    const Part& fore = body.part(PartName::left_forearm);
    const double size = std::min(p.scale, 1.2 * fore.length / 0.249), middle = 0.6 * fore.length;
    const double off = outline(fore.blobs).ring(middle).side + 0.035 * size;
    const Eigen::Isometry3d frame = fore.frame * Eigen::Translation3d(off, 0, -middle);
    body.carry(frame, {plate(0.044 * size, 0.24 * size, 0.30 * size),
                       {RoundCone{Vec3(-off, 0, 0), Vec3::Zero(), 0.03 * size, 0.03 * size}, 0.006 * size}});
}

/// A bent staff through the left palm, its ends towards the body.
void take_bow(ImplicitBody& body, double k) {
    const Part& hand = body.part(PartName::left_hand);
    std::vector<Vec3> path;
    std::vector<double> radii;
    for (const double along : {-0.55, -0.38, -0.20, 0.0, 0.20, 0.38, 0.55}) {
        path.push_back(hand.to_world(k * Vec3(0, -along, 0.075 - 0.7 * along * along)));
        radii.push_back(k * (0.023 - 0.014 * along * along));
    }
    body.carry(Eigen::Isometry3d::Identity(), fine_chain(path, radii, 0.15 * k, 0.006 * k));
}

/// A knot of a thing that the right hand grips: how far beyond the thumb, and how thick there; for an adult, in metres.
struct GripKnot {
    double beyond_thumb, radius;
};

/// A straight thing through the palm of the right hand, across it, as it is gripped. Short pieces: their bounds are.
std::vector<Blob> gripped(const ImplicitBody& body, const std::vector<GripKnot>& knots, double k) {
    constexpr double longest_piece = 0.15, blend = 0.006;
    const Part& hand = body.part(PartName::right_hand);
    std::vector<Vec3> path;
    std::vector<double> radii;
    for (std::size_t i = 0; i < knots.size(); ++i) {
        const GripKnot &to = knots[i], &from = knots[i > 0 ? i - 1 : 0];
        const int pieces = std::max(1, static_cast<int>(std::abs(to.beyond_thumb - from.beyond_thumb) / longest_piece));
        for (int piece = i > 0 ? 1 : pieces; piece <= pieces; ++piece) {
            const double u = static_cast<double>(piece) / pieces;
            path.push_back(hand.to_world(k * Vec3(0, -std::lerp(from.beyond_thumb, to.beyond_thumb, u), 0.075)));
            radii.push_back(k * std::lerp(from.radius, to.radius, u));
        }
    }
    return chain(path, radii, blend * k);
}

void take_staff(ImplicitBody& body, double k) {
    body.carry(Eigen::Isometry3d::Identity(), gripped(body, {{-0.75, 0.016}, {0.65, 0.018}, {0.80, 0.034}}, k));
}

void take_sword(ImplicitBody& body, double k) {
    body.carry(Eigen::Isometry3d::Identity(),
               gripped(body, {{-0.11, 0.024}, {0, 0.018}, {0.10, 0.020}, {0.85, 0.010}}, k));
    const Part& hand = body.part(PartName::right_hand);
    body.carry(Eigen::Isometry3d::Identity(),
               {{RoundCone{hand.to_world(k * Vec3(-0.10, -0.09, 0.075)), hand.to_world(k * Vec3(0.10, -0.09, 0.075)),
                           0.014 * k, 0.014 * k},
                 0.006 * k}});
}

void take_axe(ImplicitBody& body, double k) {
    body.carry(Eigen::Isometry3d::Identity(), gripped(body, {{-0.25, 0.018}, {0.55, 0.018}}, k));
    const Part& hand = body.part(PartName::right_hand);
    body.carry(Eigen::Isometry3d::Identity(), {{RoundCone{hand.to_world(k * Vec3(0, -0.46, 0.075)),
                                                          hand.to_world(k * Vec3(0, -0.46, 0.20)), 0.03 * k, 0.06 * k},
                                                0.01 * k}});
}

} // namespace

void put_on(ImplicitBody& body, const Proportions& p, Garment garment) {
    switch (garment) {
    case Garment::axe:
        return take_axe(body, p.scale);
    case Garment::boots:
        return put_on_boots(body, p);
    case Garment::bow:
        return take_bow(body, p.scale);
    case Garment::bun:
        return put_on_bun(body, p.head_scale);
    case Garment::cape:
        return put_on_cape(body, p);
    case Garment::coat:
        return put_on_coat(body, p.scale);
    case Garment::hat:
        return put_on_hat(body, p);
    case Garment::helmet:
        return put_on_helmet(body, p.head_scale);
    case Garment::horns:
        return put_on_horns(body, p.head_scale);
    case Garment::long_hair:
        return put_on_long_hair(body, p);
    case Garment::long_pony_tail:
        return put_on_pony_tail(body, p, BodyJoint::left_ankle);
    case Garment::mittens:
        return put_on_mittens(body, p.hand_scale);
    case Garment::pony_tail:
        return put_on_pony_tail(body, p, BodyJoint::left_hip);
    case Garment::rucksack:
        return put_on_rucksack(body, p);
    case Garment::shield:
        return take_shield(body, p);
    case Garment::skirt:
        cover_hips(body, 0.010 * p.scale);
        return add_skirt(body, 0.92, 0.016 * p.scale, 0.045 * p.scale);
    case Garment::staff:
        return take_staff(body, p.scale);
    case Garment::sword:
        return take_sword(body, p.scale);
    case Garment::tail:
        return put_on_tail(body, p.scale);
    case Garment::trousers:
        return put_on_trousers(body, p.scale);
    case Garment::wide_skirt:
        return put_on_wide_skirt(body, p);
    case Garment::wings:
        return put_on_wings(body, p);
    }
}

} // namespace skelgen::synth
