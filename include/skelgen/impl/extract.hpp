#pragma once

#include <skelgen/extract.hpp>

#include <algorithm>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/search/trust.hpp>
#include <skelgen/surface/canonical_form.hpp>
#include <skelgen/surface/manifold_parts.hpp>
#include <skelgen/symmetry/exact_mirror.hpp>

namespace skelgen {
namespace detail {

/// The components that get a curve each.
template <typename Scalar>
std::vector<surface::ManifoldParts<Scalar>> closable_components(const TriangleMesh<Scalar>& mesh) {
    constexpr double least_area = 1e-3;
    constexpr Eigen::Index least_faces = 4; // fewer enclose nothing, whatever is closed
    std::vector<surface::ManifoldParts<Scalar>> parts = surface::manifold_parts(mesh, least_area);
    std::erase_if(parts,
                  [](const surface::ManifoldParts<Scalar>& part) { return part.mesh.faces.rows() < least_faces; });
    if (parts.empty())
        throw Error(ErrorCode::bad_input, "the mesh has no component that encloses anything; close its surface");
    return parts;
}

template <typename Scalar>
bool is_all_of(const surface::ManifoldParts<Scalar>& part, const TriangleMesh<Scalar>& mesh) {
    return part.mesh.faces.rows() == mesh.faces.rows() && part.mesh.vertices.rows() == mesh.vertices.rows();
}

/// The diagonal of a mesh's bounding box along the axes that a similarity turns to x, y and z; in the mesh's unit.
template <typename Scalar>
Scalar diagonal_along(const Similarity<Scalar>& similarity, const Points<Scalar>& vertices) {
    Points<Scalar> turned(vertices.rows(), 3);
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        core::set_point<Scalar>(turned, v, similarity.to_canonical(core::point(vertices, v)));
    return similarity.scale * core::bounding_diagonal(turned);
}

/// The limb, or the head, that is not found, or with the least certainty, and where: "the left arm ends at 0.3, 1.4,
/// 0".
template <typename Scalar>
std::string least_certain_limb(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template) {
    const Joint<Scalar>* least = nullptr;
    std::string name;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const BodyPart part = part_of(joint.role);
        if (part == BodyPart::trunk && joint.role != JointRole::neck && joint.role != JointRole::head) continue;
        if (least && !(skeleton.joints[j].confidence < least->confidence)) continue;
        least = &skeleton.joints[j];
        name = part == BodyPart::trunk ? "head"
                                       : std::string(joint.side == Side::left ? "left " : "right ") +
                                             (part == BodyPart::arm ? "arm" : "leg");
    }
    if (!least) return "";
    const bool is_there = least->is_present;
    while (!least->is_present) least = &skeleton.joints[static_cast<std::size_t>(least->parent)];
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(3);
    text << "the " << name << (is_there ? " is the least certain, at " : " is not found beyond ") << least->position[0]
         << ", " << least->position[1] << ", " << least->position[2];
    return text.str();
}

/// Why the likeliest skeleton is no answer, or why there is none.
template <typename Scalar>
Failure failure_of(const search::Climb<Scalar>& climb, const SkeletonTemplate& wanted, const ExtractOptions& options) {
    constexpr std::string_view no_person = "no human body: ", no_animal = "no four-legged animal: ",
                               neither = "neither a human body nor a four-legged animal: ";
    if (climb.found.empty()) {
        Failure failure = climb.failure;
        for (const std::string_view one : {no_person, no_animal})
            if (options.or_quadruped && failure.what.starts_with(one)) failure.what.replace(0, one.size(), neither);
        return failure;
    }
    if (wanted.plan == BodyKind::quadruped || options.or_quadruped)
        return {Refusal::unlikely,
                std::string(options.or_quadruped ? neither : no_animal) +
                    "its parts have unlikely lengths, directions or girths; check that it is one body alone"};
    const search::Found<Scalar>& found = climb.found.front();
    const std::string limb = least_certain_limb(search::skeleton_in_input(found), wanted);
    std::string doubt = search::strongest_doubt(found.candidate.evidence); // what is wrong; what to do
    if (!limb.empty()) doubt.insert(std::min(doubt.find("; "), doubt.size()), " (" + limb + ")");
    return {Refusal::unlikely, std::string(no_person) + doubt};
}

template <typename Scalar>
Extraction<Scalar> extraction_of(search::Climb<Scalar> climb, const search::Found<Scalar>& found,
                                 KinematicSkeleton<Scalar> skeleton, SkeletonTemplate skeleton_template,
                                 const ExtractOptions& options) {
    Extraction<Scalar> out;
    std::vector<std::string> warnings = search::warnings_of(found, skeleton_template);
    skeleton.quality.warnings.insert(skeleton.quality.warnings.end(), warnings.begin(), warnings.end());
    out.skeleton = std::move(skeleton);
    out.skeleton_template = std::move(skeleton_template);
    out.geodesic_diameter = found.body->similarity.scale * found.candidate.geodesic_diameter;
    out.timings = climb.timings;
    if (options.with_curve) {
        core::Stopwatch stage;
        out.curve = surface::to_input(*found.body, curve::finished(*found.curve, *found.body).curve);
        out.timings.curve += stage.lap();
    }
    out.body = *found.whole;
    out.body.repairs = found.body->repairs; // also what was opened and taken off
    out.trail = std::move(climb.trail);
    return out;
}

} // namespace detail

template <typename Scalar>
Extraction<Scalar> extract_in(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    core::Stopwatch total;
    validate(options);
    const core::ThreadScope threads(options.threads);
    SkeletonTemplate wanted = search::wanted_template(options);
    search::Climb<Scalar> climb = search::climb(mesh, wanted, options);
    if (climb.found.empty() || climb.found.front().candidate.probability < search::least_probability)
        throw NoSkeleton(detail::failure_of(climb, wanted, options), std::move(climb.trail));
    const search::Found<Scalar>& found = climb.found.front();
    if (found.plan != wanted.plan) wanted = builtin_template("quadruped");
    KinematicSkeleton<Scalar> skeleton = search::skeleton_in_input(found);
    if (const auto mirror = symmetry::exact_mirror(mesh))
        skeleton =
            symmetry::mirrored_evenly(std::move(skeleton), wanted, *mirror, core::bounding_diagonal(mesh.vertices));
    Extraction<Scalar> out =
        detail::extraction_of(std::move(climb), found, std::move(skeleton), std::move(wanted), options);
    out.timings.total = total.lap();
    return out;
}

template <typename Scalar>
Extraction<Scalar> extract(TriangleMesh<Scalar> mesh, const ExtractOptions& options) {
    Extraction<Scalar> out = extract_in(mesh, options);
    out.mesh = std::move(mesh);
    return out;
}

template <typename Scalar>
std::vector<curve::CurveResult<Scalar>> find_curves(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    validate(options);
    const core::ThreadScope threads(options.threads);
    surface::require_surface(mesh);
    const auto components = detail::closable_components(mesh);
    std::optional<Scalar> size;
    if (components.size() > 1 || !detail::is_all_of(components.front(), mesh))
        size = detail::diagonal_along(surface::canonical_form(mesh).similarity, mesh.vertices);
    std::vector<curve::CurveResult<Scalar>> out;
    for (const surface::ManifoldParts<Scalar>& component : components) {
        const Body<Scalar> body = prepare(component.mesh, options.prepare);
        // What has one component alone has that one's axes.
        const Scalar all = size ? *size : detail::diagonal_along(body.similarity, mesh.vertices);
        const Scalar own = body.similarity.scale * core::bounding_diagonal(body.mesh.vertices);
        curve::CurveOptions relative = options.curve;
        relative.centring.spacing = std::min(1.0, relative.centring.spacing * static_cast<double>(all / own));
        curve::CurveResult<Scalar> found = find_curve(body, relative);
        found.curve = surface::to_input(body, found.curve);
        found.contracted.reset();
        for (std::vector<int>& region : found.curve.regions)
            for (int& vertex : region) vertex = component.source[static_cast<std::size_t>(vertex)];
        out.push_back(std::move(found));
    }
    return out;
}

template <typename Scalar>
CurveSkeleton<Scalar> find_curve_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    validate(options);
    const core::ThreadScope threads(options.threads);
    const Body<Scalar> body = prepare(mesh, options.prepare);
    return surface::to_input(body, find_curve(body, options.curve).curve);
}

} // namespace skelgen
