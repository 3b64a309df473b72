#pragma once

#include <skelgen/applications/correspondence.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <Eigen/QR>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/part_shares.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/nearest_share.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/surface/face_tree.hpp>

namespace skelgen::applications {
namespace detail {

/// Turns and stretches what is around a joint's bone from where it is to where the rest pose has it.
template <typename Scalar>
struct ToRest {
    Vector3<Scalar> from, to;         ///< the joint, and where it is in the rest pose
    Eigen::Matrix<Scalar, 3, 3> turn; ///< with the stretch
    Eigen::Matrix<Scalar, 3, 3> turn_of_normals;

    [[nodiscard]] Vector3<Scalar> operator()(const Vector3<Scalar>& place) const { return to + turn * (place - from); }
};

/// Sum of the lengths of a skeleton's bones.
template <typename Scalar>
Scalar total_length(const KinematicSkeleton<Scalar>& skeleton) {
    Scalar sum = 0;
    for (const Joint<Scalar>& joint : skeleton.joints)
        if (joint.parent >= 0 && joint.is_present)
            sum += (joint.position - skeleton.joints[static_cast<std::size_t>(joint.parent)].position).norm();
    return sum;
}

template <typename Scalar>
std::vector<ToRest<Scalar>> to_rest(const KinematicSkeleton<Scalar>& skeleton) {
    const SkeletonTemplate& wanted = own_template(skeleton);
    KinematicSkeleton<Scalar> rest = rest_skeleton<Scalar>(wanted);
    for (std::size_t j = 0; j < rest.joints.size(); ++j) rest.joints[j].is_present = skeleton.joints[j].is_present;
    const Orientations<Scalar> orientations = bone_orientations(skeleton, wanted);
    const Scalar size = total_length(rest) / total_length(skeleton);
    std::vector<ToRest<Scalar>> out;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Vector3<Scalar> from = skeleton.joints[j].position, to = rest.joints[j].position;
        const Vector3<Scalar> bone = bone_end(skeleton, wanted, static_cast<int>(j)) - from;
        const Vector3<Scalar> rest_bone = bone_end(rest, wanted, static_cast<int>(j)) - to;
        const Eigen::Matrix<Scalar, 3, 3> turn = orientations[j].conjugate().toRotationMatrix();
        Eigen::Matrix<Scalar, 3, 3> stretch = size * Eigen::Matrix<Scalar, 3, 3>::Identity();
        if (bone.norm() > 0 && rest_bone.norm() > 0) {
            const Vector3<Scalar> along = rest_bone.normalized();
            stretch += (rest_bone.norm() / bone.norm() - size) * along * along.transpose();
        }
        out.push_back({from, to, stretch * turn, turn});
    }
    return out;
}

/// The joint that each part of the set `bones` moves with.
inline std::vector<int> joints_of_parts(const std::vector<std::string>& names, const auto& skeleton) {
    static constexpr std::array<std::pair<const char*, JointRole>, 19> roles{{{"head", JointRole::head},
                                                                              {"neck", JointRole::neck},
                                                                              {"chest", JointRole::chest},
                                                                              {"abdomen", JointRole::waist},
                                                                              {"pelvis", JointRole::pelvis},
                                                                              {"shoulder", JointRole::chest},
                                                                              {"upper_arm", JointRole::shoulder},
                                                                              {"forearm", JointRole::elbow},
                                                                              {"hand", JointRole::wrist},
                                                                              {"thigh", JointRole::hip},
                                                                              {"calf", JointRole::knee},
                                                                              {"foot", JointRole::ankle},
                                                                              {"tail", JointRole::tail},
                                                                              {"fore_upper", JointRole::shoulder},
                                                                              {"fore_lower", JointRole::elbow},
                                                                              {"fore_foot", JointRole::wrist},
                                                                              {"hind_upper", JointRole::hip},
                                                                              {"hind_lower", JointRole::knee},
                                                                              {"hind_foot", JointRole::ankle}}};
    const SkeletonTemplate& own = own_template(skeleton);
    std::vector<int> out;
    for (const std::string& name : names) {
        const auto [side, plain] = split_side(name);
        const auto* const found = std::find_if(roles.begin(), roles.end(),
                                               [&plain = plain](const auto& pair) { return plain == pair.first; });
        const bool is_sided_joint = plain != "shoulder"; // a shoulder's part goes with the chest
        const int joint = find_joint(own, found->second, is_sided_joint ? side : Side::none);
        out.push_back(find_joint(skeleton, own.joint(joint).name));
    }
    return out;
}

/// For each row of `wanted` (m x d) the nearest row of `known` (n x d), the first of equals. By blocks, as products of
/// matrices: in so many dimensions no tree is faster. Single precision tells places apart that are as near as rounding
/// lets bodies be.
inline std::vector<int> nearest_rows(const Eigen::MatrixXf& known, const Eigen::MatrixXf& wanted) {
    constexpr Eigen::Index block = 256;
    const Eigen::VectorXf half_squared = known.rowwise().squaredNorm() / 2;
    std::vector<int> out(static_cast<std::size_t>(wanted.rows()));
    for (Eigen::Index first = 0; first < wanted.rows(); first += block) {
        const Eigen::Index count = std::min(block, wanted.rows() - first);
        const Eigen::MatrixXf closeness =
            (known * wanted.middleRows(first, count).transpose()).colwise() - half_squared;
        for (Eigen::Index i = 0; i < count; ++i) {
            Eigen::Index best = 0;
            closeness.col(i).maxCoeff(&best);
            out[static_cast<std::size_t>(first + i)] = static_cast<int>(best);
        }
    }
    return out;
}

/// What places are compared by in the common pose: where they are, where they look, and on which side.
template <typename Scalar>
Eigen::MatrixXf pose_features(const ComparableBody<Scalar>& body, double weight) {
    constexpr float looks = 0.04F,
                    sided = 0.3F; // lengths that opposite normals or sides are worth, relative to the size
    const Eigen::Index n = body.common.rows();
    Eigen::MatrixXf out(n, 7);
    out << body.common.template cast<float>(), looks * body.normals.template cast<float>(),
        sided * body.sides.template cast<float>();
    return static_cast<float>(weight) * out;
}

/// `count` vertices spread over the surface in the common pose: each the farthest from those before.
template <typename Scalar>
std::vector<int> spread_samples(const Points<Scalar>& points, int count) {
    std::vector<int> out{0};
    Eigen::VectorX<Scalar> distance =
        Eigen::VectorX<Scalar>::Constant(points.rows(), std::numeric_limits<Scalar>::infinity());
    while (static_cast<int>(out.size()) < std::min<int>(count, static_cast<int>(points.rows()))) {
        distance = distance.cwiseMin((points.rowwise() - points.row(out.back())).rowwise().squaredNorm());
        Eigen::Index farthest = 0;
        distance.maxCoeff(&farthest);
        out.push_back(static_cast<int>(farthest));
    }
    return out;
}

/// The rows of a matrix that are named.
template <typename Matrix>
Matrix rows_of(const Matrix& matrix, const std::vector<int>& rows) {
    Matrix out(static_cast<Eigen::Index>(rows.size()), matrix.cols());
    for (std::size_t i = 0; i < rows.size(); ++i) out.row(static_cast<Eigen::Index>(i)) = matrix.row(rows[i]);
    return out;
}

inline Eigen::MatrixXf beside(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
    Eigen::MatrixXf out(a.rows(), a.cols() + b.cols());
    out << a, b;
    return out;
}

/// How high a template is in its rest pose.
inline double rest_height(const SkeletonTemplate& wanted) {
    double low = 0, high = 0;
    for (const TemplateJoint& joint : wanted.joints) {
        low = std::min(low, joint.position.y());
        high = std::max(high, joint.tip ? joint.tip->y() : joint.position.y());
    }
    return high - low;
}

/// From how far places are from where they are sent to.
template <typename Scalar>
std::vector<double> confidences(const Points<Scalar>& places, const Points<Scalar>& others, const std::vector<int>& map,
                                double height) {
    constexpr double breadth = 0.05; // of a hand, relative to the height of human21
    std::vector<double> out;
    for (std::size_t v = 0; v < map.size(); ++v) {
        const auto apart = static_cast<double>((places.row(static_cast<Eigen::Index>(v)) - others.row(map[v])).norm());
        const double relative = apart / (breadth * height);
        out.push_back(std::exp(-2 * relative * relative));
    }
    return out;
}

} // namespace detail

SKELGEN_INLINE void validate(const CorrespondenceOptions& options) {
    core::require_in_range("correspondence.first_functions", options.first_functions, 10, 100);
    core::require_in_range("correspondence.functions", options.functions, options.first_functions, 200);
    core::require_in_range("correspondence.step", options.step, 1, 50);
    core::require_in_range("correspondence.posture", options.posture, 0.0, 2.0);
}

template <typename Scalar>
ComparableBody<Scalar> comparable(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                                  const CorrespondenceOptions& options) {
    validate(options);
    constexpr double blend = 0.04; // of the square root of the area: half a wrist
    ComparableBody<Scalar> out;
    out.faces = body.mesh.faces;
    out.basis = laplace_basis(body.mesh, options.functions);
    out.parts = segment(body, skeleton);
    out.rest_height = detail::rest_height(own_template(skeleton));
    const Segmentation& parts = out.parts;
    const KinematicSkeleton<Scalar> inside = surface::to_body(body, skeleton);
    const std::vector<detail::ToRest<Scalar>> motions = detail::to_rest(inside);
    const std::vector<int> joints = detail::joints_of_parts(parts.parts, inside);
    const auto count = static_cast<int>(parts.parts.size());
    const Eigen::MatrixX<Scalar> shares = part_shares(body, parts.vertex_part, count, blend).template cast<Scalar>();
    const Points<Scalar> normals = core::vertex_normals(body.mesh);
    const Eigen::Index n = body.mesh.vertices.rows();
    out.common.resize(n, 3);
    out.normals.resize(n, 3);
    out.sides.resize(n);
    for (Eigen::Index v = 0; v < n; ++v) {
        Vector3<Scalar> place = Vector3<Scalar>::Zero(), normal = Vector3<Scalar>::Zero();
        Scalar side = 0;
        for (int part = 0; part < count; ++part) {
            const auto& motion = motions[static_cast<std::size_t>(joints[static_cast<std::size_t>(part)])];
            const Scalar share = shares(v, part);
            place += share * motion(core::point(body.mesh.vertices, v));
            normal += share * (motion.turn_of_normals * core::point(normals, v));
            side += share * static_cast<Scalar>(sign_of(split_side(parts.parts[static_cast<std::size_t>(part)]).side));
        }
        core::set_point<Scalar>(out.common, v, place);
        core::set_point<Scalar>(out.normals, v, normal.stableNormalized());
        out.sides[v] = side;
    }
    return out;
}

template <typename Scalar>
Correspondence correspond(const ComparableBody<Scalar>& from, const ComparableBody<Scalar>& to,
                          const CorrespondenceOptions& options) {
    validate(options);
    if (options.functions > from.basis.values.size() || options.functions > to.basis.values.size())
        throw Error(ErrorCode::usage, "the bodies were made comparable with fewer functions than are asked for");
    if (from.parts.parts != to.parts.parts)
        throw Error(ErrorCode::usage, "a person and an animal have no like places; compare bodies of one plan");
    constexpr int most_samples = 1500; // as many as tell 100 functions apart, many times over (MRR19)
    using Matrix = Eigen::MatrixX<core::Accumulator>;
    const std::vector<int> samples = detail::spread_samples(from.common, most_samples);
    std::vector<int> all(static_cast<std::size_t>(from.common.rows()));
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<int>(v);
    const Eigen::MatrixXf to_pose = detail::pose_features(to, 1);
    const Matrix to_common = to.common.template cast<core::Accumulator>();
    const Matrix from_common = from.common.template cast<core::Accumulator>();
    const Matrix from_functions = detail::rows_of(from.basis.functions, samples);
    ComparableBody<Scalar> moved = from;
    std::vector<int> map = detail::nearest_rows(to_pose, detail::rows_of(detail::pose_features(from, 1), samples));
    for (int k = options.first_functions;; k = std::min(k + options.step, options.functions)) {
        // In functions of `from`, by least squares over the samples: the functions of `to` where they are sent to, and
        // how far that is.
        const Eigen::HouseholderQR<Matrix> solver(from_functions.leftCols(k));
        const Matrix change = solver.solve(detail::rows_of(Matrix(to.basis.functions.leftCols(k)), map)); // k x k
        const Matrix shift = solver.solve(detail::rows_of(to_common, map) - detail::rows_of(from_common, samples));
        moved.common = (from_common + from.basis.functions.leftCols(k) * shift).template cast<Scalar>();
        moved.normals = core::vertex_normals(TriangleMesh<Scalar>{moved.common, from.faces});
        const bool is_last = k == options.functions;
        const std::vector<int>& wanted = is_last ? all : samples;
        // By Weyl's law, k functions differ by about sqrt(pi) k d between places d apart on a unit area.
        const auto unit = static_cast<core::Accumulator>(1.77 * k);
        const Matrix mapped = detail::rows_of(from.basis.functions, wanted).leftCols(k) * change / unit;
        const auto posture = static_cast<float>(options.posture);
        map = detail::nearest_rows(
            detail::beside((to.basis.functions.leftCols(k) / unit).template cast<float>(), posture * to_pose),
            detail::beside(mapped.cast<float>(),
                           detail::rows_of(detail::pose_features(moved, options.posture), wanted)));
        if (is_last)
            return {map, detail::confidences(moved.common, to.common, map, from.rest_height),
                    moved.common.template cast<double>()};
    }
}

template <typename Scalar>
std::vector<TrianglePlace> triangle_places(const TriangleMesh<Scalar>& to, const Body<Scalar>& to_body,
                                           const ComparableBody<Scalar>& to_comparable,
                                           const Correspondence& correspondence) {
    const std::vector<int> stands_for = standing_for(to_body, to.vertices);
    TriangleMesh<Scalar> drawn{to_comparable.common, to.faces};
    for (int& corner : drawn.faces.reshaped()) corner = stands_for[static_cast<std::size_t>(corner)];
    std::vector<std::vector<int>> around(static_cast<std::size_t>(drawn.vertices.rows()));
    for (int f = 0; f < drawn.faces.rows(); ++f)
        for (int i = 0; i < 3; ++i) around[static_cast<std::size_t>(drawn.faces(f, i))].push_back(f);
    const surface::FaceTree<Scalar> tree(drawn);
    std::vector<TrianglePlace> out;
    for (std::size_t v = 0; v < correspondence.map.size(); ++v) {
        const Vector3<double> place = core::point(correspondence.bent, static_cast<Eigen::Index>(v));
        int nearest = correspondence.map[v];
        if (around[static_cast<std::size_t>(nearest)].empty()) // of a surface around all pieces: of none of their faces
            nearest = tree.nearest_corner(drawn, Vector3<Scalar>(place.cast<Scalar>()));
        TrianglePlace best;
        double least = std::numeric_limits<double>::infinity();
        for (const int face : around[static_cast<std::size_t>(nearest)]) {
            Eigen::Matrix3d corners;
            for (int i = 0; i < 3; ++i)
                corners.col(i) = core::point(drawn.vertices, drawn.faces(face, i)).template cast<double>();
            const Vector3<double> share =
                core::nearest_share<double>(place, corners.col(0), corners.col(1), corners.col(2))
                    .cwiseMax(0); // rounded
            const double apart = (corners * share - place).squaredNorm();
            if (apart < least) best = {face, {share[0], share[1], share[2]}}, least = apart;
        }
        out.push_back(best);
    }
    return out;
}

template <typename Scalar>
std::vector<Landmark> landmarks(const ComparableBody<Scalar>& from, const Correspondence& correspondence) {
    constexpr core::Accumulator time = 0.02; // relative to the area: heat has then spread over a hand
    const core::Accumulator area = from.basis.areas.sum();
    const Eigen::VectorX<core::Accumulator> decay = (-time * area * from.basis.values).array().exp();
    const Eigen::VectorX<core::Accumulator> signature = from.basis.functions.cwiseAbs2() * decay;
    std::vector<int> best(from.parts.parts.size(), -1);
    for (std::size_t v = 0; v < from.parts.vertex_part.size(); ++v) {
        int& most = best[static_cast<std::size_t>(from.parts.vertex_part[v])];
        if (most < 0 || signature[static_cast<Eigen::Index>(v)] > signature[most]) most = static_cast<int>(v);
    }
    std::vector<Landmark> out;
    for (std::size_t part = 0; part < best.size(); ++part)
        if (best[part] >= 0)
            out.push_back(
                {from.parts.parts[part], best[part], correspondence.map[static_cast<std::size_t>(best[part])]});
    return out;
}

} // namespace skelgen::applications
