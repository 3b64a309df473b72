#include <skelgen/synth/quadrupeds.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/core/skeleton_template.hpp>

#include "lines.hpp"
#include "stroke_field.hpp"

namespace skelgen::synth {
namespace {

/// How an animal is made. Lengths are parts of the trunk's, from hip to shoulder.
struct Build {
    const char* name;
    double trunk;              ///< metres
    double fore_leg, hind_leg; ///< from shoulder and hip joint to the ground
    double girth;              ///< half the trunk's width
    double neck, neck_rise;    ///< length; degrees above the horizontal
    double neck_girth, head, head_girth;
    double tail, tail_girth; ///< length 0: none
    double ear, horn;        ///< length 0: none
    double thigh, shin, paw; ///< radii of a leg at its top and bottom, length of the foot
    double wrist;            ///< height of the fore leg's wrist in its lengths; the hind leg's ankle is a little higher
};

constexpr std::array<Build, 12> builds{{
    {"dog", 0.55, 0.799, 0.9, 0.19, 0.5, 45, 0.12, 0.48, 0.12, 0.65, 0.04, 0.16, 0, 0.11, 0.05, 0.0825, 0.25},
    {"dachshund", 0.4, 0.423, 0.48, 0.16, 0.36, 45, 0.1, 0.42, 0.095, 0.5, 0.03, 0.13, 0, 0.085, 0.045, 0.0605, 0.25},
    {"cat", 0.3, 0.705, 0.8, 0.17, 0.32, 40, 0.1, 0.32, 0.115, 0.9, 0.035, 0.1, 0, 0.09, 0.045, 0.0605, 0.24},
    {"fox", 0.42, 0.705, 0.82, 0.16, 0.4, 35, 0.1, 0.42, 0.1, 0.85, 0.065, 0.15, 0, 0.085, 0.04, 0.055, 0.27},
    {"horse", 1.15, 1.08, 1.18, 0.24, 0.8, 48, 0.15, 0.58, 0.12, 0.7, 0.05, 0.12, 0, 0.14, 0.05, 0.066, 0.36},
    {"cow", 1.3, 0.846, 1, 0.29, 0.55, 15, 0.17, 0.54, 0.14, 0.8, 0.035, 0.14, 0.22, 0.14, 0.06, 0.066, 0.34},
    {"pig", 0.8, 0.545, 0.62, 0.26, 0.3, 8, 0.18, 0.42, 0.14, 0.22, 0.025, 0.12, 0, 0.115, 0.055, 0.055, 0.28},
    {"deer", 0.9, 0.987, 1.12, 0.19, 0.72, 55, 0.1, 0.42, 0.095, 0.16, 0.03, 0.17, 0.35, 0.11, 0.04, 0.055, 0.37},
    {"giraffe", 1.4, 1.46, 1.38, 0.25, 1.7, 62, 0.14, 0.52, 0.11, 0.75, 0.03, 0.14, 0.12, 0.14, 0.055, 0.066, 0.37},
    {"bear", 1.2, 0.705, 0.72, 0.28, 0.38, 15, 0.18, 0.44, 0.15, 0.12, 0.045, 0.1, 0, 0.15, 0.085, 0.105, 0.18},
    {"sheep", 0.8, 0.658, 0.75, 0.27, 0.38, 32, 0.14, 0.4, 0.115, 0.25, 0.04, 0.14, 0.16, 0.105, 0.045, 0.055, 0.33},
    {"lion", 1, 0.752, 0.85, 0.21, 0.42, 28, 0.15, 0.44, 0.14, 0.9, 0.035, 0.09, 0, 0.12, 0.065, 0.088, 0.24},
}};

enum class Pose { standing, walking, galloping, sitting, lying, grazing, on_a_side, looking, count };
constexpr std::array<const char*, static_cast<std::size_t>(Pose::count)> pose_names{
    "standing", "walking", "galloping", "sitting", "lying", "grazing", "on-a-side", "looking"};

constexpr std::array<const char*, 4> leg_names{"left_fore", "right_fore", "left_hind", "right_hind"};
constexpr bool is_fore(std::size_t leg) { return leg < 2; }
constexpr double side_of(std::size_t leg) { return leg % 2 == 0 ? 1 : -1; }

/// Degrees that a leg's upper, lower, ankle's and foot's bone point forward of down; and how far it is spread.
struct LegPose {
    std::array<double, 4> forward{};
    double spread = 2;
};

struct Holding {
    std::array<LegPose, 4> legs; ///< by `leg_names`
    double neck = 0, head = 0;   ///< degrees that neck and head point above the horizontal
    double look = 0;             ///< degrees that the neck turns to the left, and the head twice as far
    double arch = 0, sway = 0;   ///< of the trunk, degrees a joint: up and to the left
    double tail = 0, curl = 0,
           wag = 0;              ///< the tail's base above the horizontal, each of its joints further up, to the left
    bool keeps_to_ground = true; ///< the trunk is tilted until all feet stand on it
    double roll = 0;             ///< of the whole animal
};

/// Random numbers that each have a meaning of their own.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}
    double between(double low, double high) { return low + (high - low) * uniform(random_); }
    double about(double value, double share) { return value * between(1 - share, 1 + share); }
    bool one_in(double count) { return uniform(random_) * count < 1; }

private:
    std::mt19937_64 random_;
};

Build varied(Build build, Dice& dice) {
    const double hind_to_fore = build.hind_leg / build.fore_leg;
    for (double* value : {&build.trunk, &build.fore_leg, &build.girth, &build.neck, &build.neck_rise, &build.neck_girth,
                          &build.head, &build.head_girth, &build.tail, &build.tail_girth, &build.ear, &build.horn,
                          &build.thigh, &build.shin, &build.paw, &build.wrist})
        *value = dice.about(*value, 0.15);
    build.hind_leg = build.fore_leg * dice.about(hind_to_fore, 0.06);
    if (dice.one_in(8)) build.tail = 0;
    return build;
}

Holding hold(Pose pose, const Build& build, Dice& dice) {
    Holding out;
    const std::array<double, 4> fore{-28, 4, 2, 55}, hind{24, -32, 2, 55};
    const auto swing = [](LegPose& leg, double degrees) {
        for (std::size_t bone = 0; bone < 3; ++bone) leg.forward[bone] += degrees;
        leg.forward[3] += degrees / 2;
    };
    const auto lift = [&dice](LegPose& leg, bool fore_leg) { // as a leg that is carried forward
        const double share = dice.between(0.6, 1);
        const std::array<double, 4> by =
            fore_leg ? std::array<double, 4>{14, -22, -50, -50} : std::array<double, 4>{24, -26, -12, -30};
        for (std::size_t bone = 0; bone < 4; ++bone) leg.forward[bone] += share * by[bone];
    };
    for (std::size_t leg = 0; leg < 4; ++leg) {
        out.legs[leg] = {is_fore(leg) ? fore : hind, dice.between(0, 4)};
        swing(out.legs[leg], dice.between(-6, 6));
    }
    out.neck = build.neck_rise + dice.between(-8, 8);
    out.head = dice.between(-40, -10);
    out.look = dice.between(-8, 8);
    out.arch = dice.between(-4, 4), out.sway = dice.between(-3, 3);
    out.tail = dice.between(-60, 10), out.curl = dice.between(-14, 18), out.wag = dice.between(-14, 14);
    const std::size_t first = dice.one_in(2) ? 0 : 1; // whose legs go first
    switch (pose) {
    case Pose::walking:
        for (std::size_t leg = 0; leg < 4; ++leg) {
            const bool ahead = (leg % 2 == first) == is_fore(leg);
            swing(out.legs[leg], (ahead ? 1 : -1) * dice.between(10, 24));
            if (ahead && dice.one_in(2)) lift(out.legs[leg], is_fore(leg));
        }
        break;
    case Pose::galloping: {
        const bool stretched = dice.one_in(2);
        for (std::size_t leg = 0; leg < 4; ++leg) {
            const bool forward = stretched == is_fore(leg);
            swing(out.legs[leg], (forward ? 1 : -1) * dice.between(22, 34) + (leg % 2 == first ? 8 : -8));
            if (!stretched) lift(out.legs[leg], is_fore(leg));
        }
        out.arch = stretched ? dice.between(-6, 0) : dice.between(4, 10);
        out.neck -= dice.between(0, 0.4) * build.neck_rise;
        out.tail = dice.between(-20, 30);
        out.keeps_to_ground = false;
        break;
    }
    case Pose::sitting:
        for (const std::size_t leg : {2, 3})
            out.legs[leg] = {{dice.between(66, 80), dice.between(-62, -50), dice.between(58, 70), 84},
                             dice.between(10, 18)};
        for (const std::size_t leg : {0, 1}) swing(out.legs[leg], dice.between(0, 8));
        out.tail = dice.between(-10, 15), out.curl = dice.between(0, 10);
        out.arch = dice.between(0, 6);
        break;
    case Pose::lying:
        for (std::size_t leg = 0; leg < 4; ++leg)
            out.legs[leg] = is_fore(leg)
                                ? LegPose{{dice.between(-50, -35), dice.between(66, 80), 84, 86}, dice.between(6, 12)}
                                : LegPose{{dice.between(60, 75), dice.between(-58, -46), dice.between(66, 76), 84},
                                          dice.between(18, 26)};
        out.keeps_to_ground = false;
        out.tail = dice.between(-15, 10);
        break;
    case Pose::grazing:
        out.neck =
            -180 / pi * std::asin(std::clamp((build.fore_leg - 0.1) / (build.neck + 0.8 * build.head), 0.3, 0.9));
        out.head = out.neck - dice.between(0, 25);
        break;
    case Pose::on_a_side:
        for (std::size_t leg = 0; leg < 4; ++leg) swing(out.legs[leg], dice.between(-25, 25));
        out.roll = (first == 0 ? 1 : -1) * dice.between(75, 95);
        out.keeps_to_ground = false;
        break;
    case Pose::looking:
        out.look = (first == 0 ? 1 : -1) * dice.between(20, 35);
        out.neck += dice.between(-10, 15);
        break;
    case Pose::standing:
    case Pose::count:
        break;
    }
    return out;
}

/// A direction so many degrees above the horizontal and to the left of ahead.
Vec3 direction(double up, double left) {
    const double a = up * pi / 180, b = left * pi / 180;
    return {std::cos(a) * std::sin(b), -std::cos(a) * std::cos(b), std::sin(a)};
}

/// An animal that is put together: the joints first, then tubes through them.
class Builder {
public:
    Builder(const Build& build, const Holding& holding) : build_(build), holding_(holding) {
        place_trunk();
        for (std::size_t leg = 0; leg < 4; ++leg) place_leg(leg);
        place_head();
        place_tail();
    }

    /// Nothing comes near what it has once left.
    [[nodiscard]] bool is_free() const {
        constexpr double gap = 0.02;
        for (std::size_t i = 0; i < strokes_.size(); ++i) {
            const StrokeField field({strokes_[i]});
            for (std::size_t j = i + 1; j < strokes_.size(); ++j) {
                bool has_left = false;
                for (std::size_t k = 0; k < strokes_[j].line.size(); ++k) {
                    const bool is_out = field(strokes_[j].line[k]) - strokes_[j].radii[k] > gap;
                    if (has_left && !is_out) return false;
                    has_left = is_out;
                }
                if (!has_left) return false;
            }
        }
        return true;
    }

    /// Standing on the ground, in metres.
    [[nodiscard]] QuadrupedPlan plan() const {
        QuadrupedPlan out;
        const Eigen::AngleAxisd roll(holding_.roll * pi / 180, Vec3::UnitY());
        double ground = 0;
        for (const TubeStroke& stroke : strokes_)
            for (std::size_t i = 0; i < stroke.line.size(); ++i)
                ground = std::min(ground, (roll * stroke.line[i]).z() - stroke.radii[i]);
        const auto place = [&](const Vec3& p) -> Vec3 { return build_.trunk * (roll * p - Vec3(0, 0, ground)); };
        out.body.strokes = strokes_;
        for (TubeStroke& stroke : out.body.strokes) {
            for (Vec3& p : stroke.line) p = place(p);
            for (double& radius : stroke.radii) radius *= build_.trunk;
            for (Vec3& wide : stroke.wide) wide = roll * wide;
            stroke.blend *= build_.trunk;
        }
        out.body.ends = ends_;
        for (const auto& [name, p] : joints_) out.joints.emplace_back(name, place(p));
        for (const auto& [name, p] : ends_at_) out.end_points.emplace_back(name, place(p));
        return out;
    }

private:
    /// How far below its first joint a leg's foot is, without its paw's thickness.
    [[nodiscard]] double reach_down(std::size_t leg) const {
        double out = 0;
        for (std::size_t bone = 0; bone < 4; ++bone)
            out += bones_of(leg)[bone] * std::cos(holding_.legs[leg].forward[bone] * pi / 180);
        return out;
    }

    /// Lengths of upper, lower, ankle's and foot's bone: as long as the leg when it stands.
    [[nodiscard]] std::array<double, 4> bones_of(std::size_t leg) const {
        const double length = is_fore(leg) ? build_.fore_leg : build_.hind_leg, fetlock = 0.08 * length;
        const double wrist = (is_fore(leg) ? 1 : 1.25) * build_.wrist * length,
                     upper = (is_fore(leg) ? 0.32 : 0.36) * length;
        const double down = upper * std::cos((is_fore(leg) ? 28 : 24) * pi / 180);
        return {upper, (length - down - wrist) / std::cos((is_fore(leg) ? 4 : 32) * pi / 180), wrist - fetlock,
                build_.paw};
    }

    void place_trunk() {
        const double lift = (reach_down(0) + reach_down(1) - reach_down(2) - reach_down(3)) / 2;
        const double tilt = holding_.keeps_to_ground ? 180 / pi * std::asin(std::clamp(lift, -0.3, 0.85)) : 0;
        std::array<Vec3, 4> spine;
        for (std::size_t i = 0; i < 4; ++i) {
            const double bent = static_cast<double>(i) - 1; // the middle third is not
            ahead_[i] = direction(tilt - bent * holding_.arch, bent * holding_.sway);
            spine[i] = i == 0 ? Vec3::Zero() : Vec3(spine[i - 1] + ahead_[i - 1] / 3);
            // Hip joints lie lower than the spine.
            const Vec3 place = i == 0 ? Vec3(-0.35 * build_.girth * up_at(0)) : spine[i];
            joints_.emplace_back(std::array{"hips", "spine1", "spine2", "chest"}[i], place);
        }
        const double below = 0.15 * build_.girth; // so far is the trunk's middle from its spine
        std::vector<Vec3> line{spine[0] - 0.12 * ahead_[0]};
        for (std::size_t i = 0; i < 4; ++i) line.push_back(spine[i] - below * up_at(i));
        line.push_back(spine[3] + 0.10 * ahead_[3]);
        const double g = build_.girth;
        strokes_.push_back(
            trace_flat(through(line), between({0.75 * g, 0.92 * g, 0.95 * g, 1.05 * g, g, 0.8 * g}), 1.2,
                       [this](double t) { return up_at(static_cast<std::size_t>(std::min(3.0, 4 * t))); }));
    }

    [[nodiscard]] Vec3 up_at(std::size_t i) const { return ahead_[i].cross(Vec3::UnitX()).normalized(); }

    void place_leg(std::size_t leg) {
        const std::string name = leg_names[leg];
        const Vec3 out = side_of(leg) * (is_fore(leg) ? left_at(3) : left_at(0)),
                   ahead = out.cross(Vec3::UnitZ()) * side_of(leg);
        const Vec3 root = joints_[is_fore(leg) ? 3 : 0].second;
        const double g = build_.girth;
        const std::array<double, 4> bones = bones_of(leg);
        std::vector<Vec3> line;
        if (is_fore(leg)) {
            joints_.emplace_back(name + "_girdle", root + 0.6 * g * up_at(3) + 0.5 * g * out - 0.08 * ahead_[3]);
            line.push_back(root - 0.5 * g * up_at(3) + 0.62 * g * out + 0.06 * ahead_[3]);
        } else {
            joints_.emplace_back(name + "_girdle", root + 0.3 * g * out);
            line.push_back(root + 0.6 * g * out);
        }
        for (std::size_t bone = 0; bone < 4; ++bone) {
            const double a = holding_.legs[leg].forward[bone] * pi / 180, b = holding_.legs[leg].spread * pi / 180;
            const Vec3 along = std::cos(b) * (std::sin(a) * ahead - std::cos(a) * Vec3::UnitZ()) + std::sin(b) * out;
            line.push_back(line.back() + bones[bone] * along);
        }
        const std::array parts{"_upper", "_lower", "_ankle", "_foot"};
        for (std::size_t i = 0; i < 4; ++i) joints_.emplace_back(name + parts[i], line[i]);
        const double top = build_.thigh, low = build_.shin;
        line.insert(line.begin(), joint_near(strokes_.front(), line.front()));
        strokes_.push_back(soft(trace(
            through(line), between({top, (is_fore(leg) ? 1.0 : 1.2) * top, 0.65 * top, 1.1 * low, low, 0.9 * low}))));
        add_end(name.substr(0, name.find('_')) + (is_fore(leg) ? "_fore_toe" : "_hind_toe"));
    }

    void place_head() {
        const Vec3 chest = joints_[3].second;
        const double turned = -2 * holding_.sway + holding_.look;
        std::vector<Vec3> line{strokes_.front().line.back()};
        const Vec3 along = direction(holding_.neck, turned);
        const Vec3 head = line.front() + 0.5 * build_.girth * along + build_.neck * along;
        joints_.emplace_back("neck1", chest + (head - chest) / 3);
        joints_.emplace_back("neck2", chest + 2 * (head - chest) / 3);
        joints_.emplace_back("head", head);
        strokes_.push_back(
            soft(trace(through({line.front(), (line.front() + head) / 2, head}),
                       between({1.3 * build_.neck_girth, 1.05 * build_.neck_girth, 0.85 * build_.neck_girth}))));
        const Vec3 forward = direction(holding_.head, turned + holding_.look),
                   left = Vec3::UnitZ().cross(forward).normalized(), up = forward.cross(left);
        const double g = build_.head_girth;
        strokes_.push_back(soft(trace(straight(strokes_.back().line.back(), head + (build_.head - 0.5 * g) * forward),
                                      between({0.9 * g, g, 0.75 * g, 0.55 * g, 0.5 * g}))));
        const std::size_t skull = strokes_.size() - 1;
        add_end("head_tip");
        for (const double side : {1.0, -1.0}) {
            const Vec3 at = head + 0.6 * g * forward;
            const auto grow = [&](const Vec3& base, const Vec3& tip, double radius) {
                strokes_.push_back(
                    soft(trace(through({joint_near(strokes_[skull], at), base, tip}), tapering(radius, 0.6 * radius))));
            };
            const Vec3 ear = at + 0.6 * g * (up + side * left) - 0.2 * g * forward;
            joints_.emplace_back(std::string(side_prefix(side > 0 ? Side::left : Side::right)) + "ear", ear);
            if (build_.ear > 0)
                grow(ear, ear + build_.ear * (0.6 * up + 0.8 * side * left).normalized(), 0.22 * build_.ear + 0.005),
                    ++ends_;
            if (build_.horn > 0) {
                const Vec3 base = at + 0.8 * g * up + 0.3 * side * g * left + 0.3 * g * forward;
                grow(base, base + build_.horn * (up + 0.35 * side * left + 0.1 * forward).normalized(),
                     0.1 * build_.horn + 0.01),
                    ++ends_;
            }
        }
    }

    void place_tail() {
        if (!(build_.tail > 0)) {
            ++ends_; // the rump is one
            return;
        }
        const TubeStroke& trunk = strokes_.front();
        Vec3 place = trunk.line.front() - 0.1 * build_.girth * ahead_[0] + 0.25 * build_.girth * up_at(0);
        std::vector<Vec3> line{trunk.line.front()};
        for (int i = 0; i < 5; ++i) {
            line.push_back(place);
            if (i < 4) joints_.emplace_back("tail" + std::to_string(i + 1), place);
            place -= build_.tail / 4 * direction(-holding_.tail - i * holding_.curl, i * holding_.wag);
        }
        strokes_.push_back(soft(trace(
            through(line), between({1.2 * build_.tail_girth, 1.2 * build_.tail_girth, build_.tail_girth,
                                    0.9 * build_.tail_girth, 0.8 * build_.tail_girth, 0.6 * build_.tail_girth}))));
        add_end("tail_tip");
    }

    [[nodiscard]] Vec3 left_at(std::size_t i) const { return Vec3::UnitZ().cross(ahead_[i]).normalized(); }

    /// The end of the last tube is one of the body's.
    void add_end(const std::string& name) {
        const TubeStroke& stroke = strokes_.back();
        const std::size_t last = stroke.line.size() - 1;
        ends_at_.emplace_back(name, stroke.line[last] +
                                        stroke.radii[last] * (stroke.line[last] - stroke.line[last - 1]).normalized());
        ++ends_;
    }

    Build build_;
    Holding holding_;
    std::array<Vec3, 4> ahead_;       ///< at hips, spine1, spine2, chest
    std::vector<TubeStroke> strokes_; ///< the trunk first
    std::vector<std::pair<std::string, Vec3>> joints_, ends_at_;
    int ends_ = 0;
};

} // namespace

std::vector<QuadrupedPlan> quadruped_plans(std::uint64_t seed, std::size_t count) {
    constexpr std::size_t most_tries = 500;
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15; // spreads neighbouring seeds apart
    std::vector<QuadrupedPlan> out;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t kind = i % builds.size(), pose = (i + i / builds.size()) % pose_names.size();
        Dice dice(seed * golden + i);
        for (std::size_t attempt = 0; out.size() == i; ++attempt) {
            const Build build = varied(builds[kind], dice);
            const Builder animal(build, hold(static_cast<Pose>(pose), build, dice));
            if (attempt == most_tries)
                throw Error(ErrorCode::internal,
                            std::string("no ") + build.name + " is " + pose_names[pose] + " without touching itself");
            if (!animal.is_free()) continue;
            out.push_back(animal.plan());
            out.back().body.name = std::string(build.name) + "-" + pose_names[pose];
        }
    }
    return out;
}

TriangleMesh<double> synthesize_quadruped(const QuadrupedPlan& plan, int faces) {
    return synthesize_tube(plan.body, faces).mesh;
}

std::string quadruped_truth_to_json(const QuadrupedPlan& plan, const TriangleMesh<double>& mesh,
                                    const std::string& mesh_file) {
    using Json = nlohmann::ordered_json;
    const auto numbers = [](const Vec3& p) -> Json { return {p.x(), p.y(), p.z()}; };
    Json json, joints = Json::object(), markers = Json::object(), tips = Json::object();
    for (const auto& [name, p] : plan.joints) {
        joints[name] = numbers(p);
        const auto ends_in = [plain = name](const char* part) { return plain.ends_with(part); };
        if (ends_in("_foot") || name == "head") markers[name] = numbers(p);
        if (ends_in("_lower"))
            markers[name.substr(0, name.find("lower")) + (ends_in("fore_lower") ? "elbow" : "knee")] = numbers(p);
    }
    for (const auto& [name, p] : plan.end_points) tips[name] = numbers(p);
    markers["nose"] = tips["head_tip"];
    if (tips.contains("tail_tip")) markers["tail"] = tips["tail_tip"];
    json["expect"] = "quadruped";
    json["mesh"] = mesh_file;
    json["scale"] = (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
    json["source"] = "skelgen synth: exact by construction";
    json["joints"] = joints;
    json["markers"] = markers;
    json["end_points"] = tips;
    return json.dump(1) + "\n";
}

} // namespace skelgen::synth
