#pragma once

#include <skelgen/extract_hinted.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/stopwatch.hpp>
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

/// With left and right exchanged: joints, end points, and the frame's left and forward.
template <typename Scalar>
KinematicSkeleton<Scalar> with_exchanged_sides(KinematicSkeleton<Scalar> skeleton,
                                               const SkeletonTemplate& skeleton_template) {
    const auto by_name = [](auto& ends, const std::string& name) {
        return std::find_if(ends.begin(), ends.end(), [&](const auto& end) { return end.first == name; });
    };
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        if (joint.side != Side::left) continue;
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
    skeleton.frame.left = -skeleton.frame.left;
    skeleton.frame.forward = -skeleton.frame.forward;
    return skeleton;
}

/// Of all candidates, with their sides as they are and exchanged, the one that is likeliest by itself and has its
/// joints nearest to the hints.
template <typename Scalar>
std::pair<const search::Found<Scalar>*, KinematicSkeleton<Scalar>>
nearest_to(const std::vector<Hint>& hints, const std::vector<search::Found<Scalar>>& candidates,
           const SkeletonTemplate& wanted, Scalar size) {
    constexpr double near = 0.05;   // of the size: as far off hints are from what a search finds of right limbs
    constexpr double lacks_it = 18; // as much as a hint that is 30 % of the size off
    const std::vector<int> hint_of = hints_by_joint(wanted, hints);
    std::pair<const search::Found<Scalar>*, KinematicSkeleton<Scalar>> best;
    double most = -std::numeric_limits<double>::infinity();
    for (const search::Found<Scalar>& found : candidates) {
        KinematicSkeleton<Scalar> skeleton = search::skeleton_in_input(found);
        for (const bool exchanged : {false, true}) {
            if (exchanged) skeleton = with_exchanged_sides(std::move(skeleton), wanted);
            double worth = std::log(std::max(found.candidate.probability, std::numeric_limits<double>::min()));
            for (std::size_t j = 0; j < hint_of.size(); ++j)
                if (hint_of[j] >= 0 && !skeleton.joints[j].is_present)
                    worth -= lacks_it;
                else if (hint_of[j] >= 0)
                    worth -= (skeleton.joints[j].position.template cast<double>() -
                              hints[static_cast<std::size_t>(hint_of[j])].position)
                                 .squaredNorm() /
                             (2 * std::pow(near * static_cast<double>(size), 2));
            // The sides as they were found win where hints do not tell.
            if (!(worth > most)) continue;
            most = worth;
            best = {&found, skeleton};
        }
    }
    return best;
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

    const Scalar size = core::bounding_diagonal(mesh.vertices);
    auto [best, nearest] = detail::nearest_to(hints, climb.found, wanted, size);
    const std::vector<Hint> all = detail::with_mirrored(hints, *best->body, nearest, wanted);
    const std::vector<Joint<Scalar>> before = nearest.joints;
    nearest = bent_to(std::move(nearest), wanted, all, size);
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
