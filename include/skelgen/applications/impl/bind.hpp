#pragma once

#include <skelgen/applications/bind.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

#include <skelgen/applications/bones.hpp>
#include <skelgen/applications/heat_weights.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {
namespace detail {

template <typename Scalar>
int joints_inside(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton) {
    constexpr Scalar inside = Scalar(0.5);
    return static_cast<int>(
        std::count_if(skeleton.joints.begin(), skeleton.joints.end(), [&](const Joint<Scalar>& joint) {
            return core::winding_number(body.mesh, body.similarity.to_canonical(joint.position)) > inside;
        }));
}

/// Barycentric coordinates of the place on a triangle that is nearest to `p`; the triangle may be degenerate.
template <typename Scalar>
Vector3<Scalar> nearest_share(const Vector3<Scalar>& p, const Vector3<Scalar>& a, const Vector3<Scalar>& b,
                              const Vector3<Scalar>& c) {
    const Vector3<Scalar> ab = b - a, ac = c - a, normal = ab.cross(ac);
    const Scalar squared = normal.squaredNorm();
    if (squared > 0) {
        const Scalar u = normal.dot((p - a).cross(ac)) / squared, v = normal.dot(ab.cross(p - a)) / squared;
        if (u >= 0 && v >= 0 && u + v <= 1) return {1 - u - v, u, v};
    }
    const Vector3<Scalar> corners[3] = {a, b, c};
    Vector3<Scalar> best = Vector3<Scalar>::UnitX();
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const auto near = core::nearest_on_segment<Scalar, 3>(p, corners[k], corners[next]);
        if (!(near.distance < least)) continue;
        least = near.distance;
        best = Vector3<Scalar>::Zero();
        best[k] = 1 - near.along;
        best[next] += near.along;
    }
    return best;
}

/// The faces around each vertex of a mesh.
class FacesAround {
public:
    FacesAround(const Triangles& faces, Eigen::Index vertices) : begin_(static_cast<std::size_t>(vertices) + 1, 0) {
        for (Eigen::Index i = 0; i < faces.size(); ++i) ++begin_[static_cast<std::size_t>(faces.data()[i]) + 1];
        for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        faces_.resize(static_cast<std::size_t>(faces.size()));
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (int f = 0; f < faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) faces_[next[static_cast<std::size_t>(faces(f, k))]++] = f;
    }

    /// Calls `visit` with each of them.
    template <typename Visit>
    void of(int vertex, const Visit& visit) const {
        const auto v = static_cast<std::size_t>(vertex);
        for (std::size_t i = begin_[v]; i < begin_[v + 1]; ++i) visit(faces_[i]);
    }

private:
    std::vector<std::size_t> begin_; ///< per vertex of its first face in `faces_`
    std::vector<int> faces_;
};

/// The bones in the coordinates of a body, as what heats it: those that end on its surface somewhat shorter, since a
/// place on the surface sees nothing of the body, or all, as rounding has it.
template <typename Scalar>
std::vector<Bone<Scalar>> heating_bones(std::vector<Bone<Scalar>> bones, const Body<Scalar>& body,
                                        const SkeletonTemplate& skeleton_template) {
    constexpr Scalar kept = Scalar(0.9);
    for (Bone<Scalar>& bone : bones) {
        if (ends_limb(skeleton_template.joint(bone.joint).role)) bone.to = bone.from + kept * (bone.to - bone.from);
        bone.from = body.similarity.to_canonical(bone.from);
        bone.to = body.similarity.to_canonical(bone.to);
        bone.radius_from /= body.similarity.scale;
        bone.radius_to /= body.similarity.scale;
    }
    return bones;
}

/// Per vertex of the input the body's that stands for it, -1 where there is none.
template <typename Scalar>
std::vector<int> known_vertices(const Body<Scalar>& body, std::size_t vertices) {
    if (!body.nearest.empty()) return body.nearest;
    std::vector<int> known(vertices, -1);
    for (std::size_t v = 0; v < body.source.size(); ++v)
        if (body.source[v] >= 0) known[static_cast<std::size_t>(body.source[v])] = static_cast<int>(v);
    return known;
}

} // namespace detail

template <typename Scalar>
Outcome<Body<Scalar>> enclosing_body(const TriangleMesh<Scalar>& mesh, const KinematicSkeleton<Scalar>& skeleton,
                                     const surface::PrepareOptions& options) {
    const surface::BodyMaterial<Scalar> material = surface::gather(mesh, options);
    const auto all = static_cast<int>(skeleton.joints.size());
    std::optional<Body<Scalar>> best;
    int most = all / 2;
    for (const surface::Remedy remedy : material.remedies) {
        Outcome<Body<Scalar>> body = surface::make_body_by(remedy, material, options);
        if (!body) continue;
        const int inside = detail::joints_inside(*body, skeleton);
        if (inside > most) {
            most = inside;
            best = *std::move(body);
        }
        if (most == all) break;
    }
    if (!best)
        return Failure{FailureReason::no_body,
                       "the skeleton does not lie in the mesh: take that which was found in it"};
    return *std::move(best);
}

template <typename Scalar>
std::vector<SurfacePlace<Scalar>> places_on(const Body<Scalar>& body, const TriangleMesh<Scalar>& mesh) {
    const nanoflann::KDTreeEigenMatrixAdaptor<Points<Scalar>, 3, nanoflann::metric_L2_Simple> tree(3,
                                                                                                   body.mesh.vertices);
    const detail::FacesAround around(body.mesh.faces, body.mesh.vertices.rows());
    const std::vector<int> known = detail::known_vertices(body, static_cast<std::size_t>(mesh.vertices.rows()));
    std::vector<SurfacePlace<Scalar>> out(known.size());
    for (std::size_t v = 0; v < known.size(); ++v) {
        const Vector3<Scalar> place =
            body.similarity.to_canonical(core::point(mesh.vertices, static_cast<Eigen::Index>(v)));
        int vertex = known[v];
        if (vertex < 0) {
            Eigen::Index nearest = 0;
            Scalar squared = 0;
            tree.query(place.data(), 1, &nearest, &squared);
            vertex = static_cast<int>(nearest);
        }
        const bool is_itself = body.source[static_cast<std::size_t>(vertex)] >= 0 && known[v] >= 0;
        Scalar least = std::numeric_limits<Scalar>::infinity();
        around.of(vertex, [&](int f) {
            Vector3<Scalar> corners[3], share = Vector3<Scalar>::Zero();
            for (int k = 0; k < 3; ++k) {
                corners[k] = core::point(body.mesh.vertices, body.mesh.faces(f, k));
                share[k] = body.mesh.faces(f, k) == vertex ? Scalar(1) : Scalar(0);
            }
            if (!is_itself) share = detail::nearest_share(place, corners[0], corners[1], corners[2]);
            const Scalar distance =
                is_itself ? Scalar(0)
                          : (share[0] * corners[0] + share[1] * corners[1] + share[2] * corners[2] - place).norm();
            if (!(distance < least)) return;
            least = distance;
            out[v] = {f, share};
        });
    }
    return out;
}

template <typename Scalar>
Skin<Scalar> bind(const TriangleMesh<Scalar>& mesh, const KinematicSkeleton<Scalar>& skeleton,
                  const SkeletonTemplate& skeleton_template, const surface::PrepareOptions& options) {
    const auto refuse = [](const Failure& failure) { throw Error(ErrorCode::no_skeleton, failure.what); };
    const std::vector<Bone<Scalar>> bones = bones_of(skeleton, skeleton_template);
    const Outcome<Body<Scalar>> body = enclosing_body(mesh, skeleton, options);
    if (!body) refuse(body.failure());
    const Outcome<JointWeights> heat = heat_weights(*body, detail::heating_bones(bones, *body, skeleton_template),
                                                    static_cast<int>(skeleton.joints.size()));
    if (!heat) refuse(heat.failure());
    const JointWeights weights = without_islands(following_one_limb(*heat, skeleton_template), body->mesh.faces);

    Eigen::MatrixX<Scalar> carried(mesh.vertices.rows(), weights.cols());
    const std::vector<SurfacePlace<Scalar>> places = places_on(*body, mesh);
    for (Eigen::Index v = 0; v < carried.rows(); ++v) {
        const auto& [face, share] = places[static_cast<std::size_t>(v)];
        carried.row(v).setZero();
        for (int k = 0; k < 3; ++k)
            carried.row(v) += share[k] * weights.row(body->mesh.faces(face, k)).template cast<Scalar>();
    }
    return strongest_influences<Scalar>(carried);
}

} // namespace skelgen::applications
