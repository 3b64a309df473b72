#include <skelgen/render/view.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <skelgen/core/error.hpp>

namespace skelgen::render {
namespace {

using Vector = Vector3<double>;

constexpr std::array<std::pair<const char*, NamedView>, 5> view_names = {{{"front", NamedView::front},
                                                                          {"back", NamedView::back},
                                                                          {"side", NamedView::side},
                                                                          {"top", NamedView::top},
                                                                          {"three-quarter", NamedView::three_quarter}}};

[[noreturn]] void throw_bad_view(const std::string& text) {
    throw Error(ErrorCode::usage, "'" + text +
                                      "' is no view: use front, back, side, top, three-quarter or a direction towards "
                                      "the viewer such as 1,0,0.5");
}

Vector parse_direction(const std::string& text) {
    Vector direction;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0 && (at == end || *at++ != ',')) throw_bad_view(text);
        const auto [next, status] = std::from_chars(at, end, direction[axis]);
        if (status != std::errc()) throw_bad_view(text);
        at = next;
    }
    if (at != end || !direction.allFinite() || direction.norm() == 0) throw_bad_view(text);
    return direction;
}

/// The body's own directions, as far as a picture needs them. (left, up, forward) is right-handed.
struct BodyAxes {
    Vector left = Vector::UnitX();
    Vector up = Vector::UnitY();
    Vector forward = Vector::UnitZ();
};

/// A right-handed orthonormal triple from an up and a rough forward direction; false when they do not span a plane.
bool orthonormal_axes(const Vector& up, const Vector& forward, BodyAxes& axes) {
    const Vector left = up.normalized().cross(forward.normalized());
    if (!left.allFinite() || left.norm() < 1e-6) return false;
    axes.up = up.normalized();
    axes.left = left.normalized();
    axes.forward = axes.left.cross(axes.up);
    return true;
}

/// Fixes the sign that an eigenvector leaves open.
Vector with_positive_largest(Vector v) {
    Eigen::Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    return v[largest] < 0 ? Vector(-v) : v;
}

BodyAxes principal_axes(const TriangleMesh<double>& mesh) {
    BodyAxes axes;
    if (mesh.vertices.rows() == 0) return axes;
    const Points<double> centred = mesh.vertices.rowwise() - mesh.vertices.colwise().mean();
    const Eigen::Matrix3d covariance = centred.transpose() * centred;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance); // eigenvalues ascending
    orthonormal_axes(with_positive_largest(solver.eigenvectors().col(2)),
                     with_positive_largest(solver.eigenvectors().col(0)), axes);
    return axes;
}

BodyAxes body_axes(const Scene& scene) {
    BodyAxes axes;
    if (scene.skeleton && orthonormal_axes(scene.skeleton->frame.up, scene.skeleton->frame.forward, axes)) return axes;
    return principal_axes(scene.mesh);
}

Vector direction_of(NamedView view, const BodyAxes& body) {
    switch (view) {
    case NamedView::front:
        return body.forward;
    case NamedView::back:
        return -body.forward;
    case NamedView::side:
        return body.left;
    case NamedView::top:
        return body.up;
    case NamedView::three_quarter:
        return body.forward + 0.75 * body.left + 0.25 * body.up;
    }
    throw Error(ErrorCode::internal, "a view without a direction");
}

Camera camera_towards(const Vector& direction, const BodyAxes& body) {
    Camera camera;
    camera.toward = direction.normalized();
    // Seen from straight above, "up" says nothing: let the person face the lower edge of the picture.
    const Vector up_hint = std::abs(camera.toward.dot(body.up)) < 0.999 ? body.up : Vector(-body.forward);
    camera.right = up_hint.cross(camera.toward).normalized();
    camera.up = camera.toward.cross(camera.right);
    return camera;
}

} // namespace

View parse_view(const std::string& text) {
    for (const auto& [name, view] : view_names)
        if (text == name) return view;
    return parse_direction(text);
}

Camera look_at(const Scene& scene, const View& view) {
    const BodyAxes body = body_axes(scene);
    if (const auto* named = std::get_if<NamedView>(&view)) return camera_towards(direction_of(*named, body), body);
    return camera_towards(std::get<Vector>(view), body);
}

} // namespace skelgen::render
