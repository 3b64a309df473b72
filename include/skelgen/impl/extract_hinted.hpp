#pragma once

#include <skelgen/extract_hinted.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/search/posed_fit.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen {
namespace detail {

/// Per joint of the template the number of its hint; -1: none. \throws Error usage.
inline std::vector<int> hints_by_joint(const SkeletonTemplate& skeleton_template, const std::vector<Hint>& hints) {
    std::vector<int> out(skeleton_template.joints.size(), -1);
    for (std::size_t h = 0; h < hints.size(); ++h) {
        std::size_t j = 0;
        while (j < out.size() && skeleton_template.joints[j].name != hints[h].joint) ++j;
        if (j == out.size()) throw Error(ErrorCode::usage, "hint " + hints[h].joint + ": there is no such joint");
        if (out[j] >= 0) throw Error(ErrorCode::usage, "hint " + hints[h].joint + ": there are two");
        if (!hints[h].position.allFinite())
            throw Error(ErrorCode::usage, "hint " + hints[h].joint + ": its place is no point");
        out[j] = static_cast<int>(h);
    }
    return out;
}

/// Hints far from a mesh are of another one, or in another unit. \throws Error usage.
template <typename Scalar>
void require_hints_near(const std::vector<Hint>& hints, const TriangleMesh<Scalar>& mesh) {
    constexpr double far = 0.25; // of the size: farther than a limb that the mesh lacks
    if (mesh.vertices.rows() == 0) return;
    const Vector3<double> least = mesh.vertices.colwise().minCoeff().transpose().template cast<double>();
    const Vector3<double> most = mesh.vertices.colwise().maxCoeff().transpose().template cast<double>();
    for (const Hint& hint : hints) {
        const double distance = (hint.position - hint.position.cwiseMax(least).cwiseMin(most)).norm();
        if (distance > far * (most - least).norm())
            throw Error(ErrorCode::usage, "hint " + hint.joint +
                                              ": its place is far outside of the mesh; give it in the mesh's own "
                                              "coordinates and unit");
    }
}

/// Is a joint one of the trunk's?
inline bool is_of_trunk(const TemplateJoint& joint) {
    const BodyPart part = part_of(joint.role);
    return joint.role == JointRole::shoulder || joint.role == JointRole::hip ||
           (part != BodyPart::arm && part != BodyPart::leg && joint.role != JointRole::neck &&
            joint.role != JointRole::head);
}

/// With left and right of arms, of legs, or of both exchanged: joints, end points, and with the legs the frame's left
/// and forward.
template <typename Scalar>
KinematicSkeleton<Scalar> with_exchanged_sides(KinematicSkeleton<Scalar> skeleton,
                                               const SkeletonTemplate& skeleton_template, bool arms, bool legs) {
    const auto by_name = [](auto& ends, const std::string& name) {
        return std::find_if(ends.begin(), ends.end(), [&](const auto& end) { return end.first == name; });
    };
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        if (joint.side != Side::left || !(part_of(joint.role) == BodyPart::arm ? arms : legs)) continue;
        const auto other = static_cast<std::size_t>(counterpart(skeleton_template, static_cast<int>(j)));
        Joint<Scalar>&left = skeleton.joints[j], &right = skeleton.joints[other];
        std::swap(left.position, right.position);
        std::swap(left.radius, right.radius);
        std::swap(left.confidence, right.confidence);
        std::swap(left.is_present, right.is_present);
        if (!ends_limb(joint.role)) continue;
        const auto left_end = by_name(skeleton.end_points, end_point_name(skeleton_template, joint));
        const auto right_end =
            by_name(skeleton.end_points, end_point_name(skeleton_template, skeleton_template.joints[other]));
        if (left_end != skeleton.end_points.end() && right_end != skeleton.end_points.end())
            std::swap(left_end->second, right_end->second);
    }
    if (!legs) return skeleton;
    skeleton.frame.left = -skeleton.frame.left;
    skeleton.frame.forward = -skeleton.frame.forward;
    return skeleton;
}

/// Nothing is worth less by itself: hints tell more than the search.
inline constexpr double least_worth = -8;

/// A candidate with its sides in one of the ways they may be.
template <typename Scalar>
struct Reading {
    const search::Found<Scalar>* found = nullptr;
    KinematicSkeleton<Scalar> skeleton; ///< in the input's coordinates
    double worth = 0;                   ///< logarithm: how likely it is by itself, and beside the hints
};

/// All candidates with the sides of arms and legs as they are and exchanged, the worthiest first.
template <typename Scalar>
std::vector<Reading<Scalar>> readings_of(const std::vector<search::Found<Scalar>>& candidates,
                                         const std::vector<Hint>& hints, const SkeletonTemplate& wanted, Scalar size) {
    constexpr double near = 0.05;   // of the size: as far off hints are from what a search finds of right limbs
    constexpr double lacks_it = 18; // as much as a hint that is 30 % of the size off
    constexpr double twisted = 2;   // arms whose sides are against the legs'
    const std::vector<int> hint_of = hints_by_joint(wanted, hints);
    std::vector<Reading<Scalar>> out;
    for (const search::Found<Scalar>& found : candidates) {
        const KinematicSkeleton<Scalar> as_found = search::skeleton_in_input(found);
        for (const auto& [arms, legs] : {std::pair(false, false), {true, true}, {true, false}, {false, true}}) {
            Reading<Scalar> reading{&found, with_exchanged_sides(as_found, wanted, arms, legs), 0};
            reading.worth = std::max(std::log(found.candidate.probability), least_worth);
            if (arms != legs) reading.worth -= twisted;
            for (std::size_t j = 0; j < hint_of.size(); ++j) {
                if (hint_of[j] < 0) continue;
                const Joint<Scalar>& joint = reading.skeleton.joints[j];
                const double off =
                    (joint.position.template cast<double>() - hints[static_cast<std::size_t>(hint_of[j])].position)
                        .norm() /
                    (near * static_cast<double>(size));
                reading.worth -= joint.is_present ? off * off / 2 : lacks_it;
            }
            out.push_back(std::move(reading));
        }
    }
    // The sides as they were found win where hints do not tell.
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.worth > b.worth; });
    return out;
}

/// The hints, and beside them where a mirror shows the other side's joints that were not found there: that across the
/// skeleton's left in which the surface mirrors itself, where it does so around the hint.
template <typename Scalar>
std::vector<Hint> with_mirrored(std::vector<Hint> hints, const Body<Scalar>& body,
                                const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted) {
    constexpr auto across = static_cast<Scalar>(0.9);                                       // cosine
    constexpr auto alike = static_cast<Scalar>(0.02), as_found = static_cast<Scalar>(0.05); // of the size
    const Vector3<Scalar> origin = skeleton.frame.origin, tip = origin + skeleton.frame.left;
    const Vector3<Scalar> left =
        (body.similarity.to_canonical(tip) - body.similarity.to_canonical(origin)).normalized();
    const std::vector<search::MirrorPlane> planes = search::mirror_planes(body);
    const auto plane = std::find_if(planes.begin(), planes.end(), [&](const search::MirrorPlane& one) {
        return std::abs(one.normal.template cast<Scalar>().dot(left)) > across;
    });
    if (plane == planes.end()) return hints;
    const Vector3<Scalar> normal = plane->normal.template cast<Scalar>();
    const Scalar size = core::bounding_diagonal(body.mesh.vertices);
    const std::vector<int> hint_of = hints_by_joint(wanted, hints);
    for (std::size_t j = 0; j < hint_of.size(); ++j) {
        const int other = counterpart(wanted, static_cast<int>(j));
        if (hint_of[j] < 0 || other < 0 || hint_of[static_cast<std::size_t>(other)] >= 0) continue;
        const Vector3<Scalar> place =
            body.similarity.to_canonical(hints[static_cast<std::size_t>(hint_of[j])].position.template cast<Scalar>());
        const Vector3<Scalar> there = place - 2 * (normal.dot(place) - static_cast<Scalar>(plane->offset)) * normal;
        const Joint<Scalar>& found = skeleton.joints[static_cast<std::size_t>(other)];
        const bool is_found =
            found.is_present && (body.similarity.to_canonical(found.position) - there).norm() < as_found * size;
        const bool is_alike =
            surface::is_inside(body, place) == surface::is_inside(body, there) &&
            std::abs(body.tree.distance(body.mesh, place) - body.tree.distance(body.mesh, there)) < alike * size;
        if (!is_found && is_alike)
            hints.push_back({found.name, body.similarity.to_input(there).template cast<double>()});
    }
    return hints;
}

/// A skeleton with other places of its joints; frame and end points go with them. `places`: one row per joint.
template <typename Scalar>
KinematicSkeleton<Scalar> with_places(KinematicSkeleton<Scalar> skeleton, const SkeletonTemplate& wanted,
                                      const Points<double>& places) {
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        Joint<Scalar>& joint = skeleton.joints[j];
        const Vector3<Scalar> place = places.row(static_cast<Eigen::Index>(j)).transpose().template cast<Scalar>();
        for (auto& [name, end] : skeleton.end_points)
            if (ends_limb(wanted.joints[j].role) && name == end_point_name(wanted, wanted.joints[j]))
                end += place - joint.position;
        joint.position = place;
        joint.is_present = true;
    }
    const auto at = [&](JointRole role, Side side) -> Vector3<Scalar> {
        return skeleton.joints[static_cast<std::size_t>(find_joint(wanted, role, side))].position;
    };
    const Vector3<Scalar> left = at(JointRole::hip, Side::left), right = at(JointRole::hip, Side::right);
    BodyFrame<Scalar>& frame = skeleton.frame;
    frame.origin = skeleton.joints.front().position;
    frame.up = (at(JointRole::neck, Side::none) - (left + right) / 2).normalized();
    frame.left = (left - right - (left - right).dot(frame.up) * frame.up).normalized();
    frame.forward = frame.left.cross(frame.up);
    return skeleton;
}

/// Joints as hints and surface together have them, where no candidate was likely beside the hints: bodies in any pose
/// are laid into the surface from the best readings on, and from bodies at rest, all of them bent to the hints first.
/// \returns the cheapest, its joints in the input's coordinates; none where the template is no person's, or the
/// best reading has no extent.
template <typename Scalar>
std::optional<KinematicSkeleton<Scalar>> laid_to(const std::vector<Hint>& hints,
                                                 const std::vector<Reading<Scalar>>& readings,
                                                 const SkeletonTemplate& wanted, Scalar size) {
    constexpr std::size_t most_readings = 24, most_standing = 60;
    constexpr double worth_weight = 0.5; // beside a fit's cost
    const Body<Scalar>& body = *readings.front().found->body;
    std::vector<Points<double>> standing = search::standing_starts(body, wanted);
    if (standing.empty()) return std::nullopt;
    const KinematicSkeleton<Scalar>& best = readings.front().skeleton;
    const auto canonical = [&](const Vector3<double>& place) -> Vector3<double> {
        return body.similarity.to_canonical(place.cast<Scalar>().eval()).template cast<double>();
    };
    std::vector<search::KnownPlace> known;
    const std::vector<int> hint_of = hints_by_joint(wanted, hints);
    for (std::size_t j = 0; j < hint_of.size(); ++j)
        if (hint_of[j] >= 0)
            known.push_back({static_cast<int>(j), canonical(hints[static_cast<std::size_t>(hint_of[j])].position)});
    std::vector<Points<double>> starts;
    std::vector<double> worth; // of each start
    const auto add = [&](const KinematicSkeleton<Scalar>& skeleton, double its_worth) {
        const KinematicSkeleton<Scalar> bent = bent_to(skeleton, wanted, hints, size);
        Points<double> places(static_cast<Eigen::Index>(bent.joints.size()), 3);
        for (std::size_t j = 0; j < bent.joints.size(); ++j)
            places.row(static_cast<Eigen::Index>(j)) =
                canonical(bent.joints[j].position.template cast<double>()).transpose();
        starts.push_back(std::move(places));
        worth.push_back(its_worth);
    };
    for (std::size_t r = 0; r < std::min(most_readings, readings.size()); ++r)
        add(readings[r].skeleton, readings[r].worth);
    const auto off = [&](const Points<double>& places) {
        double sum = 0;
        for (const auto& [joint, place] : known) sum += (places.row(joint).transpose() - place).squaredNorm();
        return sum;
    };
    std::stable_sort(standing.begin(), standing.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });
    const auto in_input = [&](Points<double> places) {
        for (Eigen::Index j = 0; j < places.rows(); ++j)
            places.row(j) = body.similarity.to_input(Vector3<Scalar>(places.row(j).transpose().template cast<Scalar>()))
                                .transpose()
                                .template cast<double>();
        return places;
    };
    for (std::size_t s = 0; s < std::min(most_standing, standing.size()); ++s)
        add(with_places(best, wanted, in_input(standing[s])), least_worth);
    const std::vector<search::PosedFit> fits = search::fit_posed(body, wanted, starts, known);
    if (fits.empty()) return std::nullopt;
    const auto price = [&](const search::PosedFit& fit) { return fit.cost - worth_weight * worth[fit.start]; };
    const auto cheapest =
        std::min_element(fits.begin(), fits.end(), [&](const auto& a, const auto& b) { return price(a) < price(b); });
    return with_places(best, wanted, in_input(cheapest->joints));
}

} // namespace detail

template <typename Scalar>
KinematicSkeleton<Scalar> bent_to(KinematicSkeleton<Scalar> skeleton, const SkeletonTemplate& skeleton_template,
                                  const std::vector<Hint>& hints, Scalar size) {
    constexpr double trunk_holds = 20; // times 1/size: as much as bones of a twentieth of the body
    constexpr double shortest = 0.01;  // of the size: shorter bones are no stiffer
    constexpr double exactly = 1e9;    // as much stiffer than anything else hints are
    const std::vector<int> hint_of = detail::hints_by_joint(skeleton_template, hints);
    const auto count = static_cast<Eigen::Index>(skeleton.joints.size());
    // The displacements that cost bones and trunk the least, all of them springs.
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(count, count);
    Eigen::MatrixX3d pull = Eigen::MatrixX3d::Zero(count, 3);
    const auto relative = [&](const Vector3<Scalar>& v) -> Eigen::Vector3d {
        return v.template cast<double>() / static_cast<double>(size);
    };
    // Limbs that a hint shows to be longer than they were found have all joints up to it.
    for (std::size_t h = 0; h < hint_of.size(); ++h)
        for (int j = hint_of[h] >= 0 ? static_cast<int>(h) : -1; j >= 0;
             j = skeleton.joints[static_cast<std::size_t>(j)].parent)
            skeleton.joints[static_cast<std::size_t>(j)].is_present = true;
    const double template_size = [&] {
        Points<double> points(count, 3);
        for (Eigen::Index j = 0; j < count; ++j)
            core::set_point<double>(points, j, skeleton_template.joint(static_cast<int>(j)).position);
        return core::bounding_diagonal(points);
    }();
    for (Eigen::Index j = 0; j < count; ++j) {
        const Joint<Scalar>& joint = skeleton.joints[static_cast<std::size_t>(j)];
        if (joint.parent >= 0) {
            const Joint<Scalar>& parent = skeleton.joints[static_cast<std::size_t>(joint.parent)];
            double length = relative(joint.position - parent.position).norm();
            if (length < shortest) // joints that lie where a limb ends before them
                length = std::max(shortest, (skeleton_template.joint(static_cast<int>(j)).position -
                                             skeleton_template.joint(joint.parent).position)
                                                    .norm() /
                                                template_size);
            const double spring = 1 / length;
            stiffness(j, j) += spring;
            stiffness(joint.parent, joint.parent) += spring;
            stiffness(j, joint.parent) -= spring;
            stiffness(joint.parent, j) -= spring;
        }
        const int hint = hint_of[static_cast<std::size_t>(j)];
        if (hint >= 0) {
            stiffness(j, j) += exactly;
            pull.row(j) += exactly * relative(hints[static_cast<std::size_t>(hint)].position.template cast<Scalar>() -
                                              joint.position)
                                         .transpose();
        } else if (detail::is_of_trunk(skeleton_template.joints[static_cast<std::size_t>(j)])) {
            stiffness(j, j) += trunk_holds;
        }
    }
    const Eigen::MatrixX3d moved = stiffness.ldlt().solve(pull) * static_cast<double>(size);
    for (Eigen::Index j = 0; j < count; ++j) {
        Joint<Scalar>& joint = skeleton.joints[static_cast<std::size_t>(j)];
        const TemplateJoint& known = skeleton_template.joints[static_cast<std::size_t>(j)];
        const Vector3<Scalar> move = moved.row(j).transpose().template cast<Scalar>();
        joint.position += move;
        if (ends_limb(known.role))
            for (auto& [name, place] : skeleton.end_points)
                if (name == end_point_name(skeleton_template, known)) place += move;
        const int hint = hint_of[static_cast<std::size_t>(j)];
        if (hint < 0) continue;
        joint.position = hints[static_cast<std::size_t>(hint)].position.template cast<Scalar>();
        joint.confidence = 1;
    }
    skeleton.frame.origin = skeleton.joints.front().position;
    return skeleton;
}

template <typename Scalar>
Extraction<Scalar> extract_hinted(TriangleMesh<Scalar> mesh, const std::vector<Hint>& hints,
                                  const ExtractOptions& options) {
    core::Stopwatch total;
    validate(options);
    const core::ThreadScope threads(options.threads);
    SkeletonTemplate wanted = search::wanted_template(options);
    std::vector<search::KnownPlace> known;
    const std::vector<int> hint_of = detail::hints_by_joint(wanted, hints);
    for (std::size_t j = 0; j < hint_of.size(); ++j)
        if (hint_of[j] >= 0)
            known.push_back({static_cast<int>(j), hints[static_cast<std::size_t>(hint_of[j])].position});
    detail::require_hints_near(hints, mesh);
    ExtractOptions with_one = options; // hints are joints of one template
    with_one.or_quadruped = false;
    search::Climb<Scalar> climb = search::climb(mesh, wanted, with_one, search::Thoroughness::exhaustive, known);
    if (climb.found.empty()) throw NoSkeleton(climb.failure, std::move(climb.trail));

    constexpr double likely = -3; // worth of a reading: below it laid bodies are nearer to the truth
    const Scalar size = core::bounding_diagonal(mesh.vertices);
    const std::vector<detail::Reading<Scalar>> readings = detail::readings_of(climb.found, hints, wanted, size);
    const search::Found<Scalar>* best = readings.front().found;
    KinematicSkeleton<Scalar> nearest = readings.front().skeleton;
    std::optional<KinematicSkeleton<Scalar>> laid;
    if (readings.front().worth < likely) laid = detail::laid_to(hints, readings, wanted, size);
    const std::vector<Hint> all = laid ? hints : detail::with_mirrored(hints, *best->body, nearest, wanted);
    const std::vector<Joint<Scalar>> before = nearest.joints;
    nearest = bent_to(laid ? *std::move(laid) : std::move(nearest), wanted, all, size);
    for (std::size_t h = hints.size(); h < all.size(); ++h) { // nobody has vouched for these
        const auto j = static_cast<std::size_t>(find_joint(nearest, all[h].joint));
        nearest.joints[j].confidence = before[j].confidence;
    }
    Extraction<Scalar> out =
        detail::extraction_of(std::move(climb), *best, std::move(nearest), std::move(wanted), options);
    out.mesh = std::move(mesh);
    out.timings.total = total.lap();
    return out;
}

} // namespace skelgen
