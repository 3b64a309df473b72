#include "anatomy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace skelgen::synth {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct LimbRow {
    double at;       ///< fraction of the bone
    double side;     ///< half the width
    double depth;    ///< half the depth
    double fat;      ///< added to both per unit of Proportions::fat
    double muscle;   ///< added to both per unit of Proportions::muscle above the average
    double back = 0; ///< how far its middle lies behind the bone: the knee's joint is in its front half
};

/// The thickness along arms and legs relative to their joints is calibrated: it has the mean, the minima and the maxima
/// that the straight limbs of FAUST's registered bodies have.
template <std::size_t n>
Tube limb_outline(const Proportions& p, const std::array<LimbRow, n>& rows, double woman_at_top, double length,
                  double low_cap, double high_cap) {
    constexpr double woman_at_end = 0.10; // thinner by that than a man
    std::vector<Ring> rings;
    for (const LimbRow& row : rows) {
        const double woman = std::lerp(woman_at_top, woman_at_end, row.at);
        const double thin = 1 - woman * (1 - p.masculinity) - 0.07 * (1 - p.maturity);
        const double more = row.fat * p.fat + row.muscle * (p.muscle - 0.3);
        const double k = p.limb_scale, side = k * (thin * row.side + more), depth = k * (thin * row.depth + more);
        rings.push_back({row.at * length, side, depth - k * row.back, depth + k * row.back});
    }
    const double low = low_cap * rings.front().side, high = high_cap * rings.back().side;
    return Tube(std::move(rings), 2, low, high);
}

constexpr std::array<LimbRow, 6> upper_arm_rows{{{0.00, .0485, .0524, .030, .016},
                                                 {0.16, .0484, .0522, .034, .020},
                                                 {0.38, .0455, .0494, .034, .018},
                                                 {0.60, .0417, .0456, .030, .014},
                                                 {0.82, .0408, .0418, .022, .006},
                                                 {1.00, .0385, .0385, .014, .004}}};

constexpr std::array<LimbRow, 7> forearm_rows{{{0.00, .0385, .0385, .014, .004},
                                               {0.18, .0405, .0425, .018, .010},
                                               {0.38, .0373, .0423, .016, .009},
                                               {0.62, .0306, .0357, .012, .004},
                                               {0.82, .0252, .0318, .008, .001},
                                               {0.92, .0231, .0308, .007, .000},
                                               {1.00, .0206, .0288, .006, .000}}};

constexpr std::array<LimbRow, 7> thigh_rows{{{0.00, .0560, .0860, .022, .012},
                                             {0.14, .0640, .0880, .026, .014},
                                             {0.34, .0742, .0822, .034, .016},
                                             {0.54, .0673, .0731, .036, .014},
                                             {0.74, .0599, .0650, .030, .010},
                                             {0.90, .0594, .0638, .020, .002, .006},
                                             {1.00, .0528, .0572, .016, .002, .010}}};

constexpr std::array<LimbRow, 8> calf_rows{{{0.00, .0517, .0561, .016, .002, .010},
                                            {0.10, .0526, .0570, .018, .004, .006},
                                            {0.26, .0564, .0618, .022, .012},
                                            {0.40, .0561, .0616, .020, .011},
                                            {0.58, .0470, .0515, .015, .005},
                                            {0.76, .0371, .0414, .010, .001},
                                            {0.90, .0340, .0394, .008, .000},
                                            {1.00, .0339, .0413, .007, .000}}};

/// A finger of three phalanges from its knuckle, curled towards the palm (-x). `web`: of its blend with what is beside
/// it, of a usual finger.
HandDigit add_finger(std::vector<Blob>& blobs, const Vec3& knuckle, double spread, double curl, double length,
                     double radius, double web) {
    constexpr std::array<double, 3> share{0.46, 0.30, 0.24}, bend{1.0, 1.15, 0.8};
    HandDigit digit;
    Vec3 at = digit.places[0] = knuckle;
    double angle = 0;
    for (std::size_t i = 0; i < share.size(); ++i) {
        angle += curl * bend[i];
        const Vec3 direction(-std::sin(angle), std::cos(angle) * std::sin(spread), std::cos(angle) * std::cos(spread));
        const Vec3 next = at + length * share[i] * direction;
        const double thick = radius * (1 - 0.09 * static_cast<double>(i)),
                     thin = radius * (1 - 0.09 * static_cast<double>(i + 1));
        blobs.push_back({RoundCone{at, next, thick, thin}, i == 0 ? web * radius / 0.009 : 0.002 * radius / 0.009});
        digit.places[i + 1] = at = next;
        digit.end_radius = thin;
    }
    return digit;
}

/// One of a hand's fingers at rest: where its knuckle is, across the palm and beyond the wrist; metres and degrees.
struct FingerRow {
    double y, z, length, radius, splay;
};

/// From the thumb's side on.
std::vector<FingerRow> finger_rows(int fingers) {
    switch (fingers) {
    case 1:
        return {{.0000, .086, .084, .0140, 0}};
    case 2:
        return {{-.0190, .085, .084, .0130, -6}, {.0180, .084, .079, .0125, 9}};
    case 3:
        return {{-.0275, .084, .079, .0105, -9}, {.0000, .087, .086, .0108, 0}, {.0265, .081, .072, .0100, 11}};
    default:
        return {{-.0310, .084, .077, .0088, -9},
                {-.0105, .087, .086, .0090, -2},
                {.0100, .084, .080, .0087, 5},
                {.0295, .077, .063, .0078, 14}};
    }
}

struct FingerAngles {
    double curl, spread; ///< radians
};

/// Those of fingers that have grown together are alike.
std::vector<FingerAngles> finger_angles(const std::vector<FingerRow>& rows, const JointAngles& pose,
                                        const HandShape& shape) {
    std::vector<FingerAngles> angles;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const DigitShape& own = shape.digit[i + 1];
        const double splay = rows[i].splay, outwards = splay < 0 ? -1 : 1;
        angles.push_back({(10 + pose.bend + own.curl) * degree,
                          splay * degree + pose.side * degree * splay / 10 + outwards * own.spread * degree});
    }
    for (std::size_t first = 0, end = 1; first < angles.size(); first = end++) {
        while (end < angles.size() && shape.digit[end].joined) ++end;
        FingerAngles mean{0, 0};
        for (std::size_t i = first; i < end; ++i) mean.curl += angles[i].curl, mean.spread += angles[i].spread;
        const auto n = static_cast<double>(end - first);
        if (end - first > 1)
            std::fill(angles.begin() + static_cast<std::ptrdiff_t>(first),
                      angles.begin() + static_cast<std::ptrdiff_t>(end), FingerAngles{mean.curl / n, mean.spread / n});
    }
    return angles;
}

/// The thumb and its ball. `thick`: more than a usual one.
HandDigit add_thumb(std::vector<Blob>& blobs, double k, double puffy, double thick, double spread, double curl) {
    const double out = 1 + 0.02 * spread;
    HandDigit thumb{{k * Vec3(-0.004, -0.018, 0.022), k * Vec3(-0.010, -0.044 * out, 0.052),
                     k * Vec3(-0.013, -0.060 * out, 0.082), k * Vec3(-0.015, -0.068 * out, 0.106)},
                    0.0080 * k * puffy * thick};
    auto& [root, base, middle, tip] = thumb.places;
    if (curl != 0) {
        const Vec3 across = (middle - base).cross(Vec3(-0.5, 0.87, 0)).normalized(), last = tip - middle;
        const Eigen::AngleAxisd bent(curl * degree, across);
        middle = base + bent * (middle - base);
        tip = middle + bent * (bent * last);
    }
    blobs.push_back({RoundCone{root, base, 0.0155 * k * puffy, 0.0125 * k * puffy}, 0.012 * k});
    blobs.push_back({RoundCone{base, middle, 0.0122 * k * puffy * thick, 0.0100 * k * puffy * thick}, 0.004 * k});
    blobs.push_back({RoundCone{middle, tip, 0.0102 * k * puffy * thick, thumb.end_radius}, 0.003 * k});
    return thumb;
}

/// What the fingers close around, beside the thumb and as thick as there is room for.
RoundCone held_by(std::vector<Blob> blobs, const HandDigit& finger, double k, HeldThing thing) {
    constexpr double gap = 0.0015;
    set_bounds(blobs);
    const Vec3 palm = finger.places[0] + k * Vec3(-0.012, 0, -0.010);
    const double x = (palm.x() + finger.places[2].x()) / 2, z = (palm.z() + finger.places[2].z()) / 2;
    const double before = thing == HeldThing::staff ? 0.5 : thing == HeldThing::rod ? 0.14 : 0;
    double room = 0.03;
    for (const double y : {-0.08, -0.06, -0.04, -0.02, 0.0, 0.02, 0.04})
        if (before > 0 || y == 0) room = std::min(room, evaluate(blobs, Vec3(x, y * k, z), 1) / k);
    const double radius = std::max(0.004, room - gap) * k;
    return {Vec3(x, -before * k, z), Vec3(x, (before > 0 ? 0.8 * before : 0.001) * k, z), radius, radius};
}

} // namespace

const Tube& outline(const std::vector<Blob>& limb) { return std::get<Tube>(limb.front().form); }

std::vector<Blob> upper_arm(const Proportions& p) {
    const double k = p.limb_scale, strong = 1 + 0.4 * (p.muscle - 0.3) + 0.5 * p.fat - 0.10 * (1 - p.masculinity);
    std::vector<Blob> blobs{{limb_outline(p, upper_arm_rows, 0.04, p.upper_arm, 0.8, 0.9), 0}};
    // The deltoid caps the shoulder and ends above the middle third of the bone.
    blobs.push_back({Ellipsoid{k * Vec3(0.003, 0.000, 0.016), k * strong * Vec3(0.053, 0.060, 0.068)}, 0.02 * k});
    return blobs;
}

std::vector<Blob> forearm(const Proportions& p) {
    return {{limb_outline(p, forearm_rows, 0.10, p.forearm, 0.9, 0.8), 0}};
}

std::vector<Blob> thigh(const Proportions& p) {
    const double k = p.limb_scale, full = k * (1 + 0.4 * p.fat - 0.03 * (1 - p.masculinity) - 0.10 * (1 - p.maturity));
    std::vector<Blob> blobs{{limb_outline(p, thigh_rows, 0.02, p.thigh, 0.75, 0.9), 0}};
    // The great trochanter and the flesh over it: joint and bone lie towards the inner side of the upper thigh.
    const Vec3 top((0.028 + 0.03 * p.fat) * k, 0, -0.01 * k), end((0.004 + 0.01 * p.fat) * k, 0, 0.37 * p.thigh);
    blobs.push_back({RoundCone{top, end, 0.073 * full, 0.067 * full}, 0.02 * k});
    return blobs;
}

std::vector<Blob> calf(const Proportions& p) {
    const double k = p.limb_scale, thin = 1 - 0.10 * (1 - p.masculinity) - 0.07 * (1 - p.maturity);
    std::vector<Blob> blobs{{limb_outline(p, calf_rows, 0.10, p.calf, 0.95, 0.9), 0}};
    blobs.push_back({Ellipsoid{k * Vec3(0, -0.036 * thin - 0.012 * p.fat, 0.004), k * thin * Vec3(0.025, 0.020, 0.030)},
                     0.018 * k});
    return blobs;
}

Hand hand(const Proportions& p, const JointAngles& fingers, const HandShape& shape) {
    const double k = p.hand_scale, puffy = 1 + 0.2 * p.fat;
    const auto ring = [&](double at, double side, double depth) {
        return Ring{at * k, side * k * puffy, depth * k, depth * k};
    };
    Hand result;
    result.blobs.push_back({Tube({ring(-0.005, .0185, .0265), ring(0.025, .0165, .0320), ring(0.055, .0150, .0390),
                                  ring(0.084, .0120, .0405)},
                                 2.5, 0.020 * k, 0.012 * k),
                            0});
    std::vector<Blob> palm = result.blobs, webs;
    const std::vector<FingerRow> rows = finger_rows(shape.digits - 1);
    const std::vector<FingerAngles> angles = finger_angles(rows, fingers, shape);
    // Fingers that are as close all along as curled ones would else be joined by a film here and there.
    const bool is_usual = shape == HandShape{};
    const double web = is_usual ? 0.006 : 0.0035;
    const auto add = [&](std::vector<Blob>& blobs, const FingerRow& row, const FingerAngles& bent) {
        return add_finger(blobs, k * Vec3(0, row.y, row.z), bent.spread, bent.curl, k * row.length,
                          k * row.radius * puffy, web);
    };
    for (std::size_t i = 0; i < rows.size(); ++i) {
        result.digits.push_back(add(result.blobs, rows[i], angles[i]));
        if (i == std::min<std::size_t>(1, rows.size() - 1))
            result.fingertip = result.digits.back().places.back() + Vec3(0, 0, k * rows[i].radius);
        if (i == 0 || is_usual) continue;
        const FingerRow &a = rows[i - 1], &b = rows[i];
        const double radius = (a.radius + b.radius) / 2;
        if (shape.digit[i].joined) {
            add(webs, {(a.y + b.y) / 2, (a.z + b.z) / 2, (a.length + b.length) / 2, 0.95 * radius, 0}, angles[i]);
            continue;
        }
        // The skin between them reaches as far up their first phalanges as that of people and characters.
        constexpr double on_bone = 0.25, thin = 0.6;
        const auto at = [&](const HandDigit& d) -> Vec3 { return d.places[0] + on_bone * (d.places[1] - d.places[0]); };
        webs.push_back({RoundCone{at(result.digits[i - 1]), at(result.digits[i]), thin * radius * k, thin * radius * k},
                        0.002 * k});
    }
    std::vector<Blob> but_thumb = result.blobs;
    constexpr std::array<double, 4> thumb_thickness{1.4, 1.3, 1.15, 1}; // beside one finger to four
    result.digits.insert(result.digits.begin(), add_thumb(result.blobs, k, puffy, thumb_thickness.at(rows.size() - 1),
                                                          fingers.side + shape.digit[0].spread, shape.digit[0].curl));
    set_bounds(palm), set_bounds(but_thumb);
    for (std::size_t i = 0; i < result.digits.size(); ++i)
        result.digits[i].is_sunk = evaluate(i == 0 ? but_thumb : palm, result.digits[i].places.back(), 1) < 0;
    // A fist has no tunnel along its palm.
    if (std::all_of(result.digits.begin() + 1, result.digits.end(), [](const HandDigit& d) { return d.is_sunk; })) {
        const auto middle = [](const HandDigit& d) -> Vec3 { return (d.places[0] + d.places[1] + d.places[2]) / 3; };
        const Vec3 from = middle(result.digits[1]), to = middle(result.digits.back()) + Vec3(0, 0.001 * k, 0);
        webs.push_back({RoundCone{from, to, 0.012 * k, 0.012 * k}, 0.003 * k});
    }
    result.blobs.insert(result.blobs.end(), webs.begin(), webs.end());
    if (shape.glove > 0) {
        for (Blob& blob : result.blobs) blob = grown(blob, shape.glove);
        for (HandDigit& digit : result.digits) digit.end_radius += shape.glove;
    }
    if (shape.holds != HeldThing::none)
        result.held = held_by(result.blobs, result.digits[std::min<std::size_t>(2, rows.size())], k, shape.holds);
    return result;
}

Foot foot(const Proportions& p, double toes_up) {
    const double k = p.foot_scale, wide = 1 + 0.10 * p.fat;
    const double sole = -p.ankle_height;
    const auto at = [&](double x, double y, double height) { return Vec3(x * k * wide, y * k, sole + height * k); };
    std::vector<Blob> blobs{{Ellipsoid{at(0, 0.022, 0.034), k * Vec3(0.031 * wide, 0.036, 0.040)}, 0}};
    const auto bone = [&](const Vec3& a, const Vec3& b, double ra, double rb, double blend) {
        blobs.push_back({RoundCone{a, b, ra * k, rb * k}, blend * k});
    };
    // The instep, one slope from the shin down to the toes.
    bone(at(0, -0.004, 0.072), at(-0.002, -0.052, 0.052), 0.032, 0.027, 0.024);
    bone(at(-0.002, -0.052, 0.052), at(-0.006, -0.122, 0.022), 0.027, 0.018, 0.02);
    bone(at(0.010, 0.020, 0.022), at(0.030, -0.100, 0.015), 0.022, 0.015, 0.024);
    bone(at(-0.024, -0.124, 0.018), at(0.028, -0.108, 0.015), 0.018, 0.014, 0.02);
    for (const double side : {1.0, -1.0})
        blobs.push_back({Ellipsoid{Vec3(side * 0.028 * k, 0.002 * k, 0), k * Vec3(0.008, 0.012, 0.013)}, 0.012 * k});
    blobs.push_back({HalfSpace{-Vec3::UnitZ(), -sole}, 0.010 * k, Use::keep});

    const Vec3 ball = at(0, -0.118, 0.016);
    const Eigen::AngleAxisd lift(-toes_up * degree, Vec3::UnitX());
    const auto bent = [&](double x, double y, double height) -> Vec3 {
        return ball + lift * (at(x, y, height) - ball);
    };
    struct ToeRow {
        double x, y, length, radius;
    };
    constexpr std::array<ToeRow, 5> toes{{{-.0250, -.142, .040, .0135},
                                          {-.0045, -.147, .032, .0095},
                                          {.0100, -.142, .030, .0090},
                                          {.0235, -.134, .027, .0085},
                                          {.0360, -.122, .024, .0085}}};
    for (const ToeRow& toe : toes) {
        const Vec3 from = bent(toe.x, toe.y, toe.radius + 0.003),
                   to = bent(toe.x * 1.02, toe.y - toe.length, toe.radius * 0.9);
        blobs.push_back({RoundCone{from, to, toe.radius * k, 0.88 * toe.radius * k}, 0.004 * k});
    }
    return {std::move(blobs), bent(-0.0255, -0.142 - 0.040 - 0.012, 0.012)};
}

} // namespace skelgen::synth
