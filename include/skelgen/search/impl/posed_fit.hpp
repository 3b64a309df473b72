#pragma once

#include <skelgen/search/posed_fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/least_squares.hpp>
#include <skelgen/search/impl/proportions.hpp>
#include <skelgen/search/laid_model.hpp>

namespace skelgen::search {
namespace detail {

/// Where bones meet and end. Limbs have theirs once for each side.
enum Node { at_pelvis, at_neck, at_top, at_shoulder, at_elbow, at_fingertip, at_hip, at_knee, at_ankle, at_toe };
inline constexpr int limb_nodes = 7, posed_nodes = 3 + 2 * limb_nodes;
enum PosedRadius { of_head, of_trunk, of_chest, of_shoulder, of_wrist, of_thigh, of_knee, of_ankle, posed_radii };

/// The nodes' places and the logarithms of the radii, in units of the height.
inline constexpr int posed_numbers = 3 * posed_nodes + posed_radii;
using PosedNumbers = Eigen::Matrix<double, posed_numbers, 1>;

inline constexpr int node_of(Node node, int side) { return node < at_shoulder ? node : node + side * limb_nodes; }
inline Vec3d place_at(const PosedNumbers& x, Node node, int side = 0) { return x.segment<3>(3 * node_of(node, side)); }

/// Where a template's joint is: so much of the way from one node to another, as place_of() has it of bodies at rest.
struct NodePart {
    Node from, to;
    int side = 0;
    double part = 0;
};

inline NodePart node_part_of(const TemplateJoint& joint) {
    using enum JointRole;
    constexpr double shoulder_of_upper_arm = 0.08, hip_of_thigh = 0.07, hand_of_forearm = 0.79;
    constexpr double wrist_of_forearm = (wrist_at - elbow_at) / (1 - elbow_at);
    const int side = joint.side == Side::right ? 1 : 0;
    switch (joint.role) {
    case waist:
        return {at_pelvis, at_neck, 0, waist_at};
    case chest:
        return {at_pelvis, at_neck, 0, chest_at};
    case neck:
        return {at_neck, at_neck};
    case head:
        return {at_neck, at_top, 0, head_at};
    case shoulder:
        return {at_shoulder, at_elbow, side, shoulder_of_upper_arm};
    case elbow:
        return {at_elbow, at_elbow, side};
    case wrist:
        return {at_elbow, at_fingertip, side, wrist_of_forearm};
    case hand:
        return {at_elbow, at_fingertip, side, hand_of_forearm};
    case hip:
        return {at_hip, at_knee, side, hip_of_thigh};
    case knee:
        return {at_knee, at_knee, side};
    case ankle:
        return {at_ankle, at_ankle, side};
    case foot:
        return {at_toe, at_toe, side};
    default:
        return {at_pelvis, at_pelvis};
    }
}

inline Vec3d place_of(const PosedNumbers& x, const NodePart& part) {
    const Vec3d from = place_at(x, part.from, part.side);
    return from + part.part * (place_at(x, part.to, part.side) - from);
}

static_assert(length_count + posed_radii == proportion_count);

inline double log_length(const Vec3d& way) {
    constexpr double least = 0.01; // of the height: a bone may have no length at all
    return std::log(way.norm() + least);
}

/// The model's proportions, lengths as the mean of both sides. `mean_length`: gets the logarithm of their geometric
/// mean.
inline Proportions proportions_of(const PosedNumbers& x, double* mean_length = nullptr) {
    const auto length = [&](Node from, int side_from, Node to, int side_to) {
        return log_length(place_at(x, to, side_to) - place_at(x, from, side_from));
    };
    const auto both = [&](Node from, Node to) { return (length(from, 0, to, 0) + length(from, 1, to, 1)) / 2; };
    Proportions out;
    out << length(at_neck, 0, at_top, 0), both(at_shoulder, at_elbow), both(at_elbow, at_fingertip),
        length(at_pelvis, 0, at_neck, 0), both(at_hip, at_knee), both(at_knee, at_ankle), both(at_ankle, at_toe),
        length(at_shoulder, 0, at_shoulder, 1), length(at_hip, 0, at_hip, 1), x.tail<posed_radii>();
    const double mean = out.head<length_count>().mean();
    if (mean_length) *mean_length = mean;
    out.array() -= mean;
    return out;
}

/// A body in some pose and what it is measured by, in units of its height.
class PosedSolver {
public:
    PosedSolver(const SurfaceDepth& depth, std::vector<std::pair<NodePart, Vec3d>> known)
        : depth_(depth), known_(std::move(known)) {}

    /// `places` of the surface that have to lie on the bones; with middles, axes have to lie in its middle, too.
    [[nodiscard]] core::LeastSquares<posed_numbers> solve(const std::vector<SurfacePlace>& places, bool with_middles,
                                                          const PosedNumbers& from, const PosedNumbers& start,
                                                          int rounds) const {
        return core::least_squares(from, rounds,
                                   [&](const PosedNumbers& x) { return equations(places, with_middles, x, start); });
    }

private:
    static constexpr std::size_t bones = 12;
    static constexpr int prior_count = 40 + proportion_count;

    static std::array<ModelBone, bones> model_of(const PosedNumbers& x) {
        const auto radius = [&](PosedRadius which) { return std::exp(x[3 * posed_nodes + which]); };
        const Vec3d pelvis = place_at(x, at_pelvis), neck = place_at(x, at_neck), top = place_at(x, at_top);
        const Vec3d skull = (top - neck).normalized() * std::min(radius(of_head), (top - neck).norm() / 2);
        const Vec3d shoulders = place_at(x, at_shoulder, 0) - place_at(x, at_shoulder, 1);
        const Vec3d hips = place_at(x, at_hip, 0) - place_at(x, at_hip, 1);
        std::array<ModelBone, bones> out;
        out[0] = {neck + skull, top - skull, radius(of_head), radius(of_head)};
        out[1] = {pelvis + 0.5 * radius(of_trunk) * (neck - pelvis).normalized(),
                  neck,
                  radius(of_trunk),
                  radius(of_chest),
                  0.5 * hips,
                  0.4 * shoulders};
        const double elbow = (radius(of_shoulder) + radius(of_wrist)) / 2, foot = 0.8 * radius(of_ankle);
        for (int side = 0; side < 2; ++side) {
            const auto at = [&](Node node) { return place_at(x, node, side); };
            const auto bone = static_cast<std::size_t>(2 + 5 * side);
            out[bone] = {at(at_shoulder), at(at_elbow), radius(of_shoulder), elbow};
            out[bone + 1] = {at(at_elbow), at(at_fingertip), elbow, radius(of_wrist)};
            out[bone + 2] = {at(at_hip), at(at_knee), radius(of_thigh), radius(of_knee)};
            out[bone + 3] = {at(at_knee), at(at_ankle), radius(of_knee), radius(of_ankle)};
            out[bone + 4] = {
                .from = at(at_ankle), .to = at(at_toe), .from_radius = foot, .to_radius = foot, .has_middle = false};
        }
        return out;
    }

    [[nodiscard]] core::NormalEquations<posed_numbers> equations(const std::vector<SurfacePlace>& places,
                                                                 bool with_middles, const PosedNumbers& x,
                                                                 const PosedNumbers& start) const {
        constexpr double near_start = 0.15; // of the height
        core::NormalEquations<posed_numbers> out;
        add_misfit(model_of(x), core::derivatives_of(bones_of, x), places, with_middles, depth_, out);
        out.add(priors(x), core::derivatives_of(priors, x));
        for (int k = 0; k < posed_numbers; ++k) {
            const double slope = k < 3 * posed_nodes ? prior_weight / near_start : prior_weight;
            out.add(slope * (x[k] - start[k]), k, slope);
        }
        for (const auto& known : known_) {
            const auto off = [&](const PosedNumbers& at) -> Vec3d {
                return (place_of(at, known.first) - known.second) / at_known;
            };
            out.add(off(x), core::derivatives_of(off, x));
        }
        return out;
    }

    static BonesNumbers<bones> bones_of(const PosedNumbers& x) { return numbers_of(model_of(x)); }

    /// What bodies have in common. Each divisor is a standard deviation, broader than over people.
    static Eigen::Matrix<double, prior_count, 1> priors(const PosedNumbers& x) {
        Eigen::Matrix<double, prior_count, 1> out;
        Eigen::Index count = 0;
        const auto add = [&](double off, double deviation) { out[count++] = prior_weight * off / deviation; };
        const auto length = [&](Node from, Node to, int side) {
            return log_length(place_at(x, to, side) - place_at(x, from, side));
        };
        const Vec3d pelvis = place_at(x, at_pelvis), neck = place_at(x, at_neck);
        const Vec3d trunk = neck - pelvis, up = trunk.normalized(), head = place_at(x, at_top) - neck;
        const Vec3d shoulders = place_at(x, at_shoulder, 0) - place_at(x, at_shoulder, 1);
        const Vec3d hips = place_at(x, at_hip, 0) - place_at(x, at_hip, 1);
        // Both sides are alike, and the trunk lies between them.
        constexpr std::array<std::pair<Node, Node>, 5> limb_bones{{{at_shoulder, at_elbow},
                                                                   {at_elbow, at_fingertip},
                                                                   {at_hip, at_knee},
                                                                   {at_knee, at_ankle},
                                                                   {at_ankle, at_toe}}};
        for (const auto& [from, to] : limb_bones) add(length(from, to, 0) - length(from, to, 1), .05);
        add(length(at_neck, at_shoulder, 0) - length(at_neck, at_shoulder, 1), .1);
        add(length(at_pelvis, at_hip, 0) - length(at_pelvis, at_hip, 1), .1);
        add(shoulders.dot(up), .03);
        add(hips.dot(up), .03);
        const Vec3d off_hips = (place_at(x, at_hip, 0) + place_at(x, at_hip, 1)) / 2 - pelvis;
        const Vec3d to_shoulders = (place_at(x, at_shoulder, 0) + place_at(x, at_shoulder, 1)) / 2 - neck;
        const Vec3d off_neck = to_shoulders - up * to_shoulders.dot(up);
        for (int i = 0; i < 3; ++i) add(off_hips[i], .02);
        for (int i = 0; i < 3; ++i) add(off_neck[i], .02);
        add(to_shoulders.dot(up) + .03, .03);
        add(1 - shoulders.normalized().dot(hips.normalized()), .2);
        add(1 - head.normalized().dot(up), .5);
        // Arms and legs mirror each other more often than not, and legs seldom go up. All this may be otherwise.
        const Vec3d across = (shoulders.normalized() + hips.normalized()).normalized();
        constexpr std::size_t arm_and_leg_bones = 4;
        for (std::size_t b = 0; b < arm_and_leg_bones; ++b) {
            const auto [from, to] = limb_bones[b];
            const auto direction = [&](int side) -> Vec3d {
                return (place_at(x, to, side) - place_at(x, from, side)).normalized();
            };
            const Vec3d left = direction(0), right = direction(1);
            const Vec3d off_mirrored = left - 2 * left.dot(across) * across - right;
            for (int i = 0; i < 3; ++i) add(robust(off_mirrored[i] / .5).first, 1);
            if (from == at_shoulder || from == at_elbow) continue;
            add(robust((1 + left.dot(up)) / .3).first, 1);
            add(robust((1 + right.dot(up)) / .3).first, 1);
        }
        constexpr double far_off = 2; // deviations, beyond which these count less: there are figures of all kinds
        for (const double off : ProportionsPrior::get().deviations(proportions_of(x)))
            add(far_off * robust(off / far_off).first, 1);
        // Knees bend forward, elbows backward, and toes point ahead.
        const Vec3d ahead = (shoulders.normalized() + hips.normalized()).normalized().cross(up);
        const auto off_line = [](const Vec3d& place, const Vec3d& from, const Vec3d& to) -> Vec3d {
            const Vec3d line = (to - from).normalized();
            return place - from - line * line.dot(place - from);
        };
        for (int side = 0; side < 2; ++side) {
            const auto at = [&](Node node) { return place_at(x, node, side); };
            const Vec3d thigh = (at(at_ankle) - at(at_hip)).normalized();
            add(std::max(0.0,
                         -off_line(at(at_knee), at(at_hip), at(at_ankle)).dot(ahead - thigh * thigh.dot(ahead)) - .01),
                .03);
            add(std::max(0.0, -off_line(at(at_toe), at(at_ankle), at(at_knee)).dot(ahead) - .01), .03);
            add(std::max(0.0, off_line(at(at_elbow), at(at_shoulder), at(at_fingertip)).dot(ahead) - .02), .06);
        }
        return out;
    }

    const SurfaceDepth& depth_;
    std::vector<std::pair<NodePart, Vec3d>> known_;
};

/// The nodes of a skeleton: fingertips and the head's top are where its joints show them.
inline PosedNumbers nodes_of(const SkeletonTemplate& wanted, const Points<double>& joints) {
    using enum JointRole;
    PosedNumbers out = PosedNumbers::Zero();
    // `other`: at the end of the line that the node and the joint are on.
    const auto set = [&](Node node, int side, JointRole role, JointRole other) {
        const Side of = node < at_shoulder ? Side::none : side == 0 ? Side::left : Side::right;
        const int j = find_joint(wanted, role, of);
        const Vec3d place = joints.row(j).transpose(), there = joints.row(find_joint(wanted, other, of)).transpose();
        const NodePart part = node_part_of(wanted.joint(j));
        const double of_line = part.from == node ? 1 - part.part : part.part;
        out.segment<3>(3 * node_of(node, side)) = there + (place - there) / of_line;
    };
    set(at_pelvis, 0, pelvis, pelvis);
    set(at_neck, 0, neck, neck);
    set(at_top, 0, head, neck);
    for (int side = 0; side < 2; ++side) {
        set(at_shoulder, side, shoulder, elbow);
        set(at_elbow, side, elbow, elbow);
        set(at_fingertip, side, wrist, elbow);
        set(at_hip, side, hip, knee);
        set(at_knee, side, knee, knee);
        set(at_ankle, side, ankle, ankle);
        set(at_toe, side, foot, foot);
    }
    return out;
}

/// Head, trunk and legs one above the other.
inline double height_of(const PosedNumbers& x) {
    const auto length = [&](Node from, Node to, int side) {
        return (place_at(x, to, side) - place_at(x, from, side)).norm();
    };
    double legs = 0;
    for (int side = 0; side < 2; ++side) legs += length(at_hip, at_knee, side) + length(at_knee, at_ankle, side);
    return length(at_neck, at_top, 0) + length(at_pelvis, at_neck, 0) + legs / 2;
}

/// The numbers as joints, with a height of that many of the body's units.
inline PosedFit posed_fit_of(const PosedNumbers& x, double height, const SkeletonTemplate& wanted) {
    const auto length = [&](Node from, Node to) {
        double sum = 0;
        for (int side = 0; side < 2; ++side) sum += (place_at(x, to, side) - place_at(x, from, side)).norm();
        return sum / 2;
    };
    PosedFit out;
    const Proportions proportions = proportions_of(x);
    out.proportions.assign(proportions.begin(), proportions.end());
    out.joints.resize(static_cast<Eigen::Index>(wanted.joints.size()), 3);
    for (int j = 0; j < static_cast<int>(wanted.joints.size()); ++j) {
        const TemplateJoint& joint = wanted.joint(j);
        const NodePart part = node_part_of(joint);
        out.joints.row(j) = (height * place_of(x, part)).transpose();
        if (ends_limb(joint.role)) out.tips.emplace_back(j, height * place_at(x, part.to, part.side));
    }
    out.skeleton_template = with_lengths(
        wanted, {.trunk = length(at_pelvis, at_neck),
                 .head = length(at_neck, at_top),
                 .arm = length(at_shoulder, at_elbow) + length(at_elbow, at_fingertip),
                 .leg = length(at_hip, at_knee) + length(at_knee, at_ankle) + 0.5 * length(at_ankle, at_toe)});
    return out;
}

/// The nodes with the likeliest radii for their lengths, which a fit starts from.
inline PosedNumbers with_radii(PosedNumbers nodes) {
    double mean = 0;
    const Proportions proportions = proportions_of(nodes, &mean);
    nodes.tail<posed_radii>() = ProportionsPrior::get().radii_with(proportions.head<length_count>()).array() + mean;
    return nodes;
}

/// Do nodes lie where others do?
inline bool are_alike(const PosedNumbers& a, const PosedNumbers& b) {
    constexpr double near = 0.03; // of the height: the root mean square
    return (a - b).head<3 * posed_nodes>().squaredNorm() < near * near * posed_nodes;
}

/// Places spread over a surface, in units of the height.
template <typename Scalar>
std::vector<SurfacePlace> places_of(const TriangleMesh<Scalar>& mesh, int count, double height) {
    std::vector<Eigen::Index> faces;
    const Places spread = spread_places(mesh, count, &faces) / height;
    std::vector<SurfacePlace> out;
    for (int i = 0; i < count; ++i)
        out.push_back({spread.row(i).transpose(), core::face_area_vector(mesh, faces[static_cast<std::size_t>(i)])
                                                      .stableNormalized()
                                                      .template cast<double>()});
    return out;
}

/// Does a template have every joint that the model is laid by, and none that the model lacks?
inline bool has_all_of_person(const SkeletonTemplate& wanted) {
    using enum JointRole;
    if (wanted.plan != BodyKind::human) return false;
    for (const JointRole role : {pelvis, neck, head})
        if (find_joint(wanted, role, Side::none) < 0) return false;
    for (const JointRole role : {shoulder, elbow, wrist, hip, knee, ankle, foot})
        for (const Side side : {Side::left, Side::right})
            if (find_joint(wanted, role, side) < 0) return false;
    return std::none_of(wanted.joints.begin(), wanted.joints.end(),
                        [](const TemplateJoint& joint) { return joint.is_absent || joint.role > foot; });
}

} // namespace detail

template <typename Scalar>
std::vector<Points<double>> standing_starts(const Body<Scalar>& body, const SkeletonTemplate& wanted) {
    using detail::Vec3d;
    if (!detail::has_all_of_person(wanted)) return {};
    const Points<double> vertices = body.mesh.vertices.template cast<double>();
    const Vec3d least = vertices.colwise().minCoeff().transpose(), most = vertices.colwise().maxCoeff().transpose();
    const Vec3d middle = (least + most) / 2;
    std::vector<Points<double>> out;
    // Canonical form: principal axes are the coordinates'.
    for (int vertical = 0; vertical < 3; ++vertical)
        for (const double upward : {1.0, -1.0})
            for (int turns = 0; turns < 4; ++turns) {
                const Vec3d up = upward * Vec3d::Unit(vertical);
                const Vec3d ahead = (turns < 2 ? 1.0 : -1.0) * Vec3d::Unit((vertical + 1 + turns % 2) % 3);
                const detail::RestFrame frame{.across = up.cross(ahead),
                                              .up = up,
                                              .ahead = ahead,
                                              .offset = up.cross(ahead).dot(middle),
                                              .floor = up.dot(upward > 0 ? least : most),
                                              .height = most[vertical] - least[vertical],
                                              .depth = ahead.dot(middle)};
                for (const detail::RestStart& proportions : detail::rest_starts)
                    for (const double angle : detail::arm_angles) {
                        const detail::RestModel model = detail::model_of(detail::start_at(proportions, angle));
                        Points<double> joints(static_cast<Eigen::Index>(wanted.joints.size()), 3);
                        for (int j = 0; j < static_cast<int>(wanted.joints.size()); ++j)
                            joints.row(j) = frame
                                                .to_body(detail::place_of(model, wanted, j),
                                                         wanted.joint(j).side == Side::right ? -1 : 1)
                                                .transpose();
                        out.push_back(std::move(joints));
                    }
            }
    return out;
}

template <typename Scalar>
std::vector<PosedFit> fit_posed(const Body<Scalar>& body, const SkeletonTemplate& wanted,
                                const std::vector<Points<double>>& starts, const std::vector<KnownPlace>& known) {
    using detail::Vec3d;
    constexpr int few = 128, more = 400;
    constexpr std::size_t most_finals = 12;
    if (starts.empty() || !detail::has_all_of_person(wanted)) return {};
    if (!(core::enclosed_volume(body.mesh) > detail::least_volume<Scalar>)) return {};
    const double height = detail::height_of(detail::nodes_of(wanted, starts.front()));
    if (!(height > 0)) return {};
    const detail::SurfaceDepth depth(body.mesh, height);
    std::vector<std::pair<detail::NodePart, Vec3d>> parts;
    for (const KnownPlace& one : known)
        parts.emplace_back(detail::node_part_of(wanted.joint(one.joint)), one.place / height);
    const detail::PosedSolver solver(depth, std::move(parts));

    struct Run {
        detail::PosedNumbers from, numbers;
        double cost;
        std::size_t start;
    };
    std::vector<Run> runs;
    for (std::size_t s = 0; s < starts.size(); ++s) {
        const detail::PosedNumbers from = detail::with_radii(detail::nodes_of(wanted, starts[s]) / height);
        runs.push_back({from, from, 0, s});
    }
    // Brings all nearer, and keeps the cheapest of those that differ.
    const auto fit = [&](const std::vector<detail::SurfacePlace>& places, bool with_middles, int rounds,
                         std::size_t most) {
        for (Run& run : runs) {
            const auto [numbers, cost] = solver.solve(places, with_middles, run.numbers, run.from, rounds);
            run.numbers = numbers;
            run.cost = cost;
        }
        std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.cost < b.cost; });
        std::vector<Run> kept;
        for (const Run& run : runs)
            if (kept.size() < most && std::none_of(kept.begin(), kept.end(), [&](const Run& other) {
                    return detail::are_alike(run.numbers, other.numbers);
                }))
                kept.push_back(run);
        runs = std::move(kept);
    };
    const std::vector<detail::SurfacePlace> roughly = detail::places_of(body.mesh, few, height);
    fit(roughly, false, 3, 60);
    fit(roughly, true, 6, most_finals);
    fit(detail::places_of(body.mesh, more, height), true, 25, most_finals);
    std::vector<PosedFit> out;
    for (const Run& run : runs) {
        out.push_back(detail::posed_fit_of(run.numbers, height, wanted));
        out.back().cost = run.cost;
        out.back().start = run.start;
    }
    return out;
}

} // namespace skelgen::search
