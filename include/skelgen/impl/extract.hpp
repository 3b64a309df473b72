#pragma once

#include <skelgen/extract.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/fitting/best_surface.hpp>
#include <skelgen/surface/canonical_form.hpp>
#include <skelgen/surface/manifold_parts.hpp>

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

} // namespace detail

template <typename Scalar>
Extraction<Scalar> extract_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    return extract_body(mesh, options).extraction;
}

template <typename Scalar>
FittedBody<Scalar> extract_body(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    core::Stopwatch total;
    validate(options);
    const core::ThreadScope threads(options.threads);
    const SkeletonTemplate& wanted =
        options.skeleton_template.joints.empty() ? builtin_template("human21") : options.skeleton_template;

    Outcome<FittedBody<Scalar>> found = fitting::fit_to_best_surface(mesh, wanted, options);
    if (!found) throw Error(ErrorCode::no_skeleton, found.failure().what);
    found->extraction.timings.total = total.lap();
    return *std::move(found);
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
