#pragma once

#include <skelgen/search/rest_fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/least_squares.hpp>
#include <skelgen/search/laid_model.hpp>

namespace skelgen::search {
namespace detail {

inline Vec3d mirrored(const Vec3d& place, const MirrorPlane& plane) {
    return place - 2 * (plane.normal.dot(place) - plane.offset) * plane.normal;
}

/// Share of the places that have another one within `reach` of where the plane mirrors them.
inline double mirrored_share_of(const Places& places, const PlaceTree& tree, const MirrorPlane& plane, double reach) {
    double near = 0;
    for (Eigen::Index i = 0; i < places.rows(); ++i)
        near += tree.nearest(mirrored(places.row(i).transpose(), plane)).second < reach ? 1 : 0;
    return near / static_cast<double>(places.rows());
}

/// The plane brought to where the places mirror themselves best, by iterative closest points, ever nearer ones.
inline MirrorPlane settled(MirrorPlane plane, const Places& places, const Places& cloud, const PlaceTree& tree,
                           double extent) {
    constexpr int rounds = 12;
    constexpr double widest = 0.12, narrowest = 0.02, narrower = 0.75; // of the extent; the last each round
    constexpr int least_pairs = 30;
    double reach = widest * extent;
    for (int round = 0; round < rounds; ++round, reach = std::max(narrower * reach, narrowest * extent)) {
        Vec3d from = Vec3d::Zero(), to = Vec3d::Zero();
        std::vector<std::pair<Vec3d, Vec3d>> pairs;
        for (Eigen::Index i = 0; i < places.rows(); ++i) {
            const Vec3d place = places.row(i).transpose();
            const auto [other, distance] = tree.nearest(mirrored(place, plane));
            if (distance >= reach) continue;
            pairs.emplace_back(place, cloud.row(other).transpose());
            from += pairs.back().first;
            to += pairs.back().second;
        }
        if (static_cast<int>(pairs.size()) < least_pairs) break;
        from /= static_cast<double>(pairs.size());
        to /= static_cast<double>(pairs.size());
        Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
        for (const auto& [a, b] : pairs) moment += (a - from) * (b - to).transpose();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(Eigen::Matrix3d((moment + moment.transpose()) / 2));
        const Vec3d normal = axes.eigenvectors().col(0); // the axis along which the pairs are most against each other
        plane.normal = normal.dot(plane.normal) < 0 ? Vec3d(-normal) : normal;
        plane.offset = plane.normal.dot(from + to) / 2;
    }
    plane.share = mirrored_share_of(places, tree, plane, narrowest * extent);
    return plane;
}

/// How far each number may be from where a fit starts: standard deviations of a broad prior.
inline RestNumbers prior_deviations() {
    RestNumbers out;
    out << .05, .12, .12, .12, .06, .04, .6, .12, .04, .06, .06, .06, .1, .06, .06, .5, .5, .5, .5, .5, .5, .5, .06;
    return out;
}

/// The frames in which a body may stand that mirrors itself in a plane: its longest extent in the plane is up or down.
inline std::array<RestFrame, 2> frames_of(const MirrorPlane& plane, const Places& cloud) {
    constexpr double stray = 0.003; // of the places at either end
    const Vec3d n = plane.normal;
    Vec3d mean = Vec3d::Zero();
    for (Eigen::Index i = 0; i < cloud.rows(); ++i) mean += cloud.row(i).transpose();
    mean /= static_cast<double>(cloud.rows());
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    for (Eigen::Index i = 0; i < cloud.rows(); ++i) {
        Vec3d d = cloud.row(i).transpose() - mean;
        d -= n.dot(d) * n;
        moment += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moment);
    const auto range = [&](const Vec3d& axis) {
        std::vector<double> along;
        for (Eigen::Index i = 0; i < cloud.rows(); ++i) along.push_back(cloud.row(i).dot(axis));
        std::sort(along.begin(), along.end());
        const auto at = static_cast<std::size_t>(stray * static_cast<double>(along.size()));
        return std::array{along[at], along[along.size() / 2], along[along.size() - 1 - at]};
    };
    Vec3d up = axes.eigenvectors().col(2), ahead = axes.eigenvectors().col(1);
    auto upright = range(up), through = range(ahead);
    if (through[2] - through[0] > upright[2] - upright[0]) {
        std::swap(up, ahead);
        std::swap(upright, through);
    }
    const double height = upright[2] - upright[0];
    return {{{n, up, n.cross(up).dot(ahead) < 0 ? Vec3d(-ahead) : ahead, plane.offset, upright[0], height,
              n.cross(up).dot(ahead) < 0 ? -through[1] : through[1]},
             {n, -up, n.cross(-up).dot(ahead) < 0 ? Vec3d(-ahead) : ahead, plane.offset, -upright[2], height,
              n.cross(-up).dot(ahead) < 0 ? -through[1] : through[1]}}};
}

/// Brings the model's numbers to where it lies in the surface.
class RestSolver {
public:
    /// `depth`: of the body; `places` on its surface and what is `known` in its coordinates.
    RestSolver(const RestFrame& frame, const Places& places, const SurfaceDepth& depth,
               const std::vector<KnownPlace>& known, const SkeletonTemplate& wanted)
        : frame_(frame), depth_(depth), known_(known), wanted_(wanted) {
        for (const auto& place : places.rowwise()) places_.push_back({frame.to_model(place.transpose())});
        for (auto& [joint, place] : known_) place = frame.to_model(place);
    }

    /// `with_middles`: whether axes have to lie in the middle, which asks for depths.
    [[nodiscard]] core::LeastSquares<numbers> solve(const RestNumbers& start, const RestNumbers& prior, int rounds,
                                                    bool with_middles) const {
        return core::least_squares(start, rounds,
                                   [&](const RestNumbers& x) { return equations(x, prior, with_middles); });
    }

private:
    [[nodiscard]] core::NormalEquations<numbers> equations(const RestNumbers& x, const RestNumbers& prior,
                                                           bool with_middles) const {
        static const RestNumbers deviations = prior_deviations();
        const auto depth_of = [&](const Vec3d& place) {
            const auto [depth, inwards] = depth_(frame_.to_body(place, 1));
            return Depth{depth / frame_.height,
                         {frame_.across.dot(inwards), frame_.up.dot(inwards), frame_.ahead.dot(inwards)}};
        };
        core::NormalEquations<numbers> out;
        const auto bones_of = [](const RestNumbers& at) { return numbers_of(model_of(at).bones); };
        add_misfit(model_of(x).bones, core::derivatives_of(bones_of, x), places_, with_middles, depth_of, out);
        for (const KnownPlace& one : known_) {
            const auto off = [&](const RestNumbers& at) -> Vec3d {
                return (place_of(model_of(at), wanted_, one.joint) - one.place) / at_known;
            };
            out.add(off(x), core::derivatives_of(off, x));
        }
        for (int k = 0; k < numbers; ++k)
            out.add(prior_weight * (x[k] - prior[k]) / deviations[k], k, prior_weight / deviations[k]);
        return out;
    }

    RestFrame frame_;
    const SurfaceDepth& depth_;
    std::vector<KnownPlace> known_;
    const SkeletonTemplate& wanted_;
    std::vector<SurfacePlace> places_;
};

/// The axes of a model that was laid into a body as a curve, and the template in it. `place`: per joint, `tip`: per end
/// of a limb where the model has it in the body.
template <typename Scalar>
void draw_lines(const Body<Scalar>& body, const SkeletonTemplate& wanted, const Points<Scalar>& place,
                const std::map<int, Vector3<Scalar>>& tip, RestFit<Scalar>& out) {
    constexpr int nodes_per_bone = 6;
    std::vector<int> children(wanted.joints.size(), 0);
    for (const TemplateJoint& joint : wanted.joints)
        if (joint.parent >= 0) ++children[static_cast<std::size_t>(joint.parent)];
    const auto is_kept = [&](int j) {
        return wanted.joint(j).parent < 0 || children[static_cast<std::size_t>(j)] != 1;
    };
    std::vector<Vector3<Scalar>> nodes;
    out.embedding.node_of_joint.assign(wanted.joints.size(), -1);
    const auto node_at = [&](const Vector3<Scalar>& where) {
        nodes.push_back(where);
        return static_cast<int>(nodes.size()) - 1;
    };
    for (int end = 0; end < static_cast<int>(wanted.joints.size()); ++end) {
        if (!is_kept(end)) continue;
        const auto at_tip = tip.find(end);
        const Vector3<Scalar> last = at_tip == tip.end() ? core::point(place, end) : at_tip->second;
        int& node = out.embedding.node_of_joint[static_cast<std::size_t>(end)];
        node = node_at(last);
        if (wanted.joint(end).parent < 0) continue;
        embedding::Chain chain{{end}, {}};
        while (chain.joints.size() < 2 || !is_kept(chain.joints.back()))
            chain.joints.push_back(wanted.joint(chain.joints.back()).parent);
        std::reverse(chain.joints.begin(), chain.joints.end());
        chain.nodes.push_back(out.embedding.node_of_joint[static_cast<std::size_t>(chain.joints.front())]);
        for (std::size_t j = 1; j < chain.joints.size(); ++j) {
            const bool is_last = j + 1 == chain.joints.size();
            const Vector3<Scalar> from = core::point(place, chain.joints[j - 1]);
            const Vector3<Scalar> to = is_last ? last : core::point(place, chain.joints[j]);
            for (int k = 1; k <= nodes_per_bone; ++k) {
                const bool is_end = is_last && k == nodes_per_bone;
                const int next = is_end ? node : node_at(from + Scalar(k) / Scalar(nodes_per_bone) * (to - from));
                out.lines.edges.push_back({std::min(chain.nodes.back(), next), std::max(chain.nodes.back(), next)});
                chain.nodes.push_back(next);
            }
        }
        out.embedding.chains.push_back(std::move(chain));
    }
    out.lines.nodes.resize(static_cast<Eigen::Index>(nodes.size()), 3);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        core::set_point<Scalar>(out.lines.nodes, static_cast<Eigen::Index>(i), nodes[i]);
        out.lines.radii.push_back(body.tree.distance(body.mesh, nodes[i]));
    }
    out.lines.regions.resize(nodes.size());
}

} // namespace detail

template <typename Scalar>
std::vector<MirrorPlane> mirror_planes(const Body<Scalar>& body) {
    using detail::Vec3d;
    constexpr int few = 256, many = 2048;
    constexpr int pairs = 30, best_pairs = 3;
    constexpr double least_share = 0.35, same_direction = 0.985, least_way = 0.15, roughly = 0.05; // of the extent
    const detail::Places places = detail::spread_places(body.mesh, few), cloud = detail::spread_places(body.mesh, many);
    const detail::PlaceTree tree(cloud);
    const double extent = (cloud.colwise().maxCoeff() - cloud.colwise().minCoeff()).maxCoeff();
    std::vector<MirrorPlane> starts;
    const Vec3d middle = cloud.colwise().mean().transpose();
    for (int k = 0; k < 3; ++k) starts.push_back({Vec3d::Unit(k), middle[k], 1}); // canonical form: principal axes
    std::vector<MirrorPlane> by_pair;
    for (int k = 0; k < pairs; ++k) {
        const Vec3d a = places.row((k * 89 + 13) % few).transpose(), b = places.row((k * 151 + 97) % few).transpose();
        const double way = (a - b).norm();
        if (way < least_way * extent) continue;
        MirrorPlane plane{(a - b) / way, 0, 0};
        plane.offset = plane.normal.dot(a + b) / 2;
        plane.share = detail::mirrored_share_of(places, tree, plane, roughly * extent);
        by_pair.push_back(plane);
    }
    const auto better = [](const MirrorPlane& a, const MirrorPlane& b) { return a.share > b.share; };
    std::stable_sort(by_pair.begin(), by_pair.end(), better);
    for (std::size_t k = 0; k < std::min<std::size_t>(best_pairs, by_pair.size()); ++k) starts.push_back(by_pair[k]);

    std::vector<MirrorPlane> out;
    for (const MirrorPlane& start : starts) {
        const MirrorPlane plane = detail::settled(start, places, cloud, tree, extent);
        if (plane.share < least_share) continue;
        if (std::any_of(out.begin(), out.end(), [&](const MirrorPlane& known) {
                return std::abs(known.normal.dot(plane.normal)) > same_direction;
            }))
            continue;
        out.push_back(plane);
    }
    std::stable_sort(out.begin(), out.end(), better);
    if (out.size() > 3) out.resize(3);
    return out;
}

template <typename Scalar>
std::optional<RestFit<Scalar>> fit_at_rest(const Body<Scalar>& body, const SkeletonTemplate& wanted,
                                           const std::vector<KnownPlace>& known) {
    using detail::Vec3d;
    constexpr int few = 256, more = 512, many = 2048, first_rounds = 3, second_rounds = 4, last_rounds = 12;
    constexpr std::size_t most_seconds = 16, most_finals = 4;
    if (std::any_of(wanted.joints.begin(), wanted.joints.end(),
                    [](const TemplateJoint& joint) { return joint.is_absent; }))
        return std::nullopt;
    if (!(core::enclosed_volume(body.mesh) > detail::least_volume<Scalar>)) return std::nullopt;
    const std::vector<MirrorPlane> planes = mirror_planes(body);
    if (planes.empty()) return std::nullopt;
    const detail::Places places = detail::spread_places(body.mesh, few),
                         closer = detail::spread_places(body.mesh, more),
                         cloud = detail::spread_places(body.mesh, many);

    struct Run {
        detail::RestFrame frame;
        double mirror;
        detail::RestNumbers prior, numbers;
        double cost;
    };
    std::vector<Run> runs;
    const detail::SurfaceDepth depth(body.mesh, 1);
    const auto solver_for = [&](const detail::RestFrame& frame, const detail::Places& at) {
        return detail::RestSolver(frame, at, depth, known, wanted);
    };
    for (const MirrorPlane& plane : planes)
        for (const detail::RestFrame& frame : detail::frames_of(plane, cloud)) {
            const auto solver = solver_for(frame, places);
            for (const detail::RestStart& start : detail::rest_starts)
                for (const double angle : detail::arm_angles) {
                    const detail::RestNumbers prior = detail::start_at(start, angle);
                    const auto [numbers, cost] = solver.solve(prior, prior, first_rounds, false);
                    runs.push_back({frame, plane.share, prior, numbers, cost});
                }
        }
    const auto cheaper = [](const Run& a, const Run& b) { return a.cost < b.cost; };
    const auto finish = [&](std::size_t most, int rounds, const detail::Places& at) {
        std::stable_sort(runs.begin(), runs.end(), cheaper);
        if (runs.size() > most) runs.resize(most);
        for (Run& run : runs) {
            const auto [numbers, cost] = solver_for(run.frame, at).solve(run.numbers, run.prior, rounds, true);
            run.numbers = numbers;
            run.cost = cost;
        }
    };
    finish(most_seconds, second_rounds, places);
    finish(most_finals, last_rounds, closer);
    const Run& best = *std::min_element(runs.begin(), runs.end(), cheaper);

    detail::RestModel model = detail::model_of(best.numbers);
    // Straight down: where feet point is for the cross-sections to see.
    if (std::none_of(known.begin(), known.end(),
                     [&](const KnownPlace& one) { return wanted.joint(one.joint).role == JointRole::foot; }))
        model.toe = model.ankle + Vec3d(0, -0.8 * model.bones[3].to_radius, 0);
    RestFit<Scalar> out;
    out.cost = best.cost;
    out.mirror = best.mirror;
    for (const KnownPlace& one : known)
        for (const int joint : {one.joint, counterpart(wanted, one.joint)})
            if (joint >= 0) out.known.push_back(joint);
    out.skeleton_template = detail::with_lengths(
        wanted, {.trunk = (model.neck - model.crotch).norm(),
                 .head = (model.top - model.neck).norm(),
                 .arm = (model.fingertip - model.shoulder).norm(),
                 .leg = (model.ankle - model.hip).norm() + 0.5 * (model.toe - model.ankle).norm()});
    const detail::RestFrame frame = best.frame;
    const auto in_body = [frame](const Vec3d& place, double side) -> Vector3<Scalar> {
        const Vec3d there = frame.to_body(place, side);
        return there.cast<Scalar>();
    };
    out.joints.positions.resize(static_cast<Eigen::Index>(wanted.joints.size()), 3);
    out.joints.is_present.assign(wanted.joints.size(), true);
    std::map<int, Vector3<Scalar>> tips;
    for (int j = 0; j < static_cast<int>(wanted.joints.size()); ++j) {
        const TemplateJoint& joint = wanted.joint(j);
        const double side = joint.side == Side::right ? -1 : 1;
        core::set_point<Scalar>(out.joints.positions, j, in_body(detail::place_of(model, wanted, j), side));
        if (!ends_limb(joint.role)) continue;
        const Vec3d tip = joint.role == JointRole::head   ? model.top
                          : joint.role == JointRole::hand ? model.fingertip
                                                          : model.toe;
        tips.emplace(j, in_body(tip, side));
        const int vertex = body.tree.nearest_corner(body.mesh, in_body(tip, side));
        out.joints.tips.emplace_back(j, core::point(body.mesh.vertices, vertex));
    }
    detail::draw_lines(body, wanted, out.joints.positions, tips, out);
    return out;
}

} // namespace skelgen::search
