#include <skelgen/refinement/refine.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/refinement/limbs.hpp>

#include "bone_line.hpp"

namespace skelgen {
namespace {

using detail::Line;
using enum JointRole;

constexpr double degrees_per_radian = 57.29577951308232;

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

class Refiner {
public:
    Refiner(const TriangleMesh<double>& mesh, const std::vector<EndPoint>& ends, const CurveSkeleton<double>& curve,
            const Embedding& embedding, const SkeletonTemplate& skeleton_template, const RefinementOptions& options)
        : mesh_(mesh), adjacency_(face_adjacency(mesh.faces)), slicer_(mesh, adjacency_), curve_(curve),
          embedding_(embedding), template_(skeleton_template), options_(options),
          scale_(template_scale(skeleton_template, geodesic_diameter(ends))),
          limbs_(trace_limbs(slicer_, ends, skeleton_template, scale_, options.centreline)) {
        const auto joints = static_cast<Eigen::Index>(template_.joints.size());
        out_.positions = Points<double>::Zero(joints, 3);
        out_.radii = Eigen::VectorXd::Zero(joints);
    }

    RefinedJoints run() {
        for (const Limb& limb : limbs_) {
            place_by_ratio(limb);
            thin_wrist(limb);
            bend(limb);
            out_.tips.emplace_back(limb.joints.back(), limb.line.points.row(limb.line.points.rows() - 1).transpose());
        }
        for (const Limb& limb : limbs_) extend_to_girdle(limb);
        narrow_hips();
        place_trunk();
        raise_crotch();
        keep_inside();
        measure_radii();
        return std::move(out_);
    }

private:
    [[nodiscard]] const TemplateJoint& joint(int j) const { return template_.joints[static_cast<std::size_t>(j)]; }
    [[nodiscard]] Vector3<double> at(int j) const { return out_.positions.row(j); }
    void put(int j, const Vector3<double>& p) { out_.positions.row(j) = p.transpose(); }
    [[nodiscard]] double rest_distance(int a, int b) const {
        return scale_ * (joint(a).position - joint(b).position).norm();
    }
    [[nodiscard]] static double end_arc(const Limb& limb) { return limb.line.arc[limb.line.arc.size() - 1]; }
    [[nodiscard]] static double arc_of(const Limb& limb, std::size_t i) { return end_arc(limb) - limb.from_tip[i]; }
    [[nodiscard]] static Vector3<double> on(const Limb& limb, double arc) {
        return point_at(limb.line.points, limb.line.arc, arc);
    }
    [[nodiscard]] std::optional<std::size_t> find(const Limb& limb, JointRole role) const {
        for (std::size_t i = 0; i < limb.joints.size(); ++i)
            if (joint(limb.joints[i]).role == role) return i;
        return std::nullopt;
    }
    [[nodiscard]] int find(JointRole role) const {
        for (std::size_t j = 0; j < template_.joints.size(); ++j)
            if (template_.joints[j].role == role) return static_cast<int>(j);
        return -1;
    }

    /// Joints at the template's length ratios (LF20 3.1), counted from the limb's end, which the mesh shows, not from the
    /// trunk, where the curve is anybody's guess.
    void place_by_ratio(const Limb& limb) {
        for (std::size_t i = 0; i < limb.joints.size(); ++i) put(limb.joints[i], on(limb, arc_of(limb, i)));
    }

    /// Wrist: the thinnest section near it (LF20 3.2.2).
    void thin_wrist(const Limb& limb) {
        const auto wrist = find(limb, JointRole::wrist);
        if (!wrist || *wrist == 0) return;
        const double window = options_.wrist_window * (limb.from_tip[*wrist - 1] - limb.from_tip[*wrist]);
        const double centre = arc_of(limb, *wrist);
        Eigen::Index thinnest = -1;
        for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i) {
            if (std::abs(limb.line.arc[i] - centre) > window || limb.line.area[i] <= 0) continue;
            if (thinnest < 0 || limb.line.thickness[i] < limb.line.thickness[thinnest]) thinnest = i;
        }
        if (thinnest >= 0) put(limb.joints[*wrist], limb.line.points.row(thinnest).transpose());
    }

    /// Elbow, knee: where the lines of its two bones meet when bent, at its length ratio when straight.
    void bend(const Limb& limb) {
        for (std::size_t i = 1; i + 1 < limb.joints.size(); ++i) {
            const JointRole role = joint(limb.joints[i]).role;
            if (role != elbow && role != knee) continue;
            const double here = arc_of(limb, i), inner = arc_of(limb, i - 1), outer = arc_of(limb, i + 1);
            const double inner_start = std::max(limb.attachment, inner + 0.15 * (here - inner));
            const auto upper = detail::fit_bone(limb.line, inner_start, here - 0.2 * (here - inner), options_.flatness);
            const auto lower = detail::fit_bone(limb.line, here + 0.2 * (outer - here), outer - 0.1 * (outer - here), options_.flatness);
            if (!upper || !lower) continue;
            const double angle = std::acos(std::clamp(upper->direction.dot(lower->direction), -1.0, 1.0)) * degrees_per_radian;
            const auto meeting = detail::meeting_point(*upper, *lower);
            const Vector3<double> ratio = at(limb.joints[i]);
            if (!meeting || (*meeting - ratio).norm() > 0.3 * (outer - inner)) continue;
            put(limb.joints[i], ratio + smooth_step(options_.bend_from, options_.bend_full, angle) * (*meeting - ratio));
        }
    }

    /// Shoulder, hip: the limb's own sections end short of them; the line of the bone goes on to its length. Where the
    /// bone shows too little of itself, in a deep crouch or behind crossed arms, that line points anywhere: then of all the
    /// ways to go on the one that keeps the rest-pose distance from the trunk best.
    void extend_to_girdle(const Limb& limb) {
        if (limb.joints.size() < 2) return;
        const int top = limb.joints[0], next = limb.joints[1];
        const JointRole role = joint(top).role;
        if (role != shoulder && role != hip) return;
        const double inner = arc_of(limb, 0), outer = arc_of(limb, 1);
        const auto line = detail::fit_bone(limb.line, std::max(limb.attachment, inner + 0.15 * (outer - inner)),
                                           outer - 0.15 * (outer - inner), options_.flatness);
        const double length = rest_distance(top, next);
        const auto towards = [&](const Vector3<double>& p) -> Vector3<double> {
            return at(next) + length * (p - at(next)).normalized();
        };
        std::vector<Vector3<double>> ways;
        if (line) ways.push_back(at(next) - length * line->direction);
        if (limb.attachment < outer - 0.3 * (outer - inner)) ways.push_back(towards(on(limb, limb.attachment)));
        ways.push_back(towards(on(limb, inner)));
        put(top, ways.front());
        const int anchor = role == shoulder ? find(JointRole::neck) : -1;
        if (anchor < 0) return;
        const double rest = rest_distance(top, anchor);
        const auto misfit = [&](const Vector3<double>& p) { return std::abs((p - at(anchor)).norm() - rest); };
        if (misfit(ways.front()) > options_.girdle_tolerance * rest)
            put(top, *std::min_element(ways.begin(), ways.end(),
                                       [&](const auto& p, const auto& q) { return misfit(p) < misfit(q); }));
    }

    /// Centre of the limb's last own section, for the limb that begins with joint `j`.
    [[nodiscard]] Vector3<double> attachment_point(int j) const {
        for (const Limb& limb : limbs_)
            if (limb.joints.front() == j) return on(limb, std::max(limb.attachment, arc_of(limb, 0)));
        return at(j);
    }

    /// Hips: on the line between them (LF20 3.2.2), at their rest-pose distance. The line of a thigh passes its hip on the
    /// outside, since a thigh bone runs inwards from the hip's neck.
    void narrow_hips() {
        std::vector<int> hips;
        for (std::size_t j = 0; j < template_.joints.size(); ++j)
            if (template_.joints[j].role == hip) hips.push_back(static_cast<int>(j));
        if (hips.size() != 2) return;
        const Vector3<double> centre = 0.5 * (at(hips[0]) + at(hips[1]));
        Vector3<double> across = at(hips[0]) - at(hips[1]);
        const double rest = rest_distance(hips[0], hips[1]);
        const Vector3<double> thighs = attachment_point(hips[0]) - attachment_point(hips[1]);
        const bool crossed = across.dot(thighs) < 0.3 * rest * thighs.norm(); // thigh lines that met before the hips
        if (crossed) across = thighs;
        if (!crossed && across.norm() <= rest) return;
        put(hips[0], centre + 0.5 * rest * across.normalized());
        put(hips[1], centre - 0.5 * rest * across.normalized());
    }

    /// Mean position of both joints of a role; none when the template has none.
    [[nodiscard]] std::optional<Vector3<double>> middle(JointRole role) const {
        Vector3<double> sum = Vector3<double>::Zero();
        double count = 0;
        for (std::size_t j = 0; j < template_.joints.size(); ++j)
            if (template_.joints[j].role == role) {
                sum += at(static_cast<int>(j));
                count += 1;
            }
        if (count == 0) return std::nullopt;
        return Vector3<double>(sum / count);
    }

    /// Trunk: from the middle of the hips to the neck, joints at their rest-pose heights, centred in their sections.
    void place_trunk() {
        const Vector3<double> low = middle(hip).value_or(curve_.nodes.row(embedding_.node_of_joint[static_cast<std::size_t>(find(pelvis))]));
        const int top = find(JointRole::neck) >= 0 ? find(JointRole::neck) : find(chest);
        if (find(JointRole::neck) < 0) put(top, middle(shoulder).value_or(low));
        const Vector3<double> high = at(top), axis = (high - low);
        const double rest_low = middle_rest_height(hip), rest_high = joint(top).position.z();
        for (std::size_t j = 0; j < template_.joints.size(); ++j) {
            const TemplateJoint& here = template_.joints[j];
            if (here.role != pelvis && here.role != waist && here.role != chest) continue;
            if (static_cast<int>(j) == top) continue;
            const double t = (here.position.z() - rest_low) / (rest_high - rest_low);
            put(static_cast<int>(j), centred(low + t * axis, axis.normalized(), here.role == waist));
        }
    }

    [[nodiscard]] double middle_rest_height(JointRole role) const {
        double sum = 0, count = 0;
        for (const TemplateJoint& here : template_.joints)
            if (here.role == role) {
                sum += here.position.z();
                count += 1;
            }
        return count > 0 ? sum / count : 0;
    }

    [[nodiscard]] Vector3<double> centred(const Vector3<double>& p, const Vector3<double>& direction, bool centre) const {
        if (!centre) return p;
        const auto section = slicer_.around(p, direction, 0.1 * scale_);
        return section && (section->centroid - p).norm() < section->thickness ? section->centroid : p;
    }

    /// Crotch: nearer to the surface than a thigh is thick, it lies too low and moves towards the waist (LF20 3.2.2).
    void raise_crotch() {
        const int low = find(pelvis), above = find(waist) >= 0 ? find(waist) : find(chest);
        double thickness = 0, count = 0;
        for (const Limb& limb : limbs_) {
            if (joint(limb.joints.front()).role != hip || limb.joints.size() < 2) continue;
            for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i) {
                if (limb.line.arc[i] < limb.attachment || limb.line.arc[i] > arc_of(limb, 1)) continue;
                thickness += limb.line.thickness[i];
                count += 1;
            }
        }
        if (count == 0) return;
        const Vector3<double> start = at(low), end = at(above);
        constexpr int steps = 10;
        for (int step = 0; step <= steps; ++step) {
            put(low, start + step * 0.5 / steps * (end - start)); // never past the middle of the bone
            if (depth(at(low)) >= options_.crotch_depth * thickness / count) return;
        }
    }

    /// Distance to the nearest vertex of the surface.
    [[nodiscard]] double depth(const Vector3<double>& p) const {
        return (mesh_.vertices.rowwise() - p.transpose()).rowwise().norm().minCoeff();
    }

    /// A joint that landed outside goes to the nearest place on the curve skeleton's own centre that is inside.
    void keep_inside() {
        for (Eigen::Index j = 0; j < out_.positions.rows(); ++j) {
            const Vector3<double> p = out_.positions.row(j);
            if (winding_number(mesh_, p) > 0.5) continue;
            Eigen::Index nearest = 0;
            (curve_.nodes.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
            const Vector3<double> target = curve_.nodes.row(nearest);
            for (int step = 1; step <= 20; ++step) {
                const Vector3<double> q = p + step / 20.0 * (target - p);
                if (winding_number(mesh_, q) <= 0.5 && step < 20) continue;
                const Vector3<double> deeper = p + std::min(1.0, (step + 1) / 20.0) * (target - p);
                out_.positions.row(j) = (winding_number(mesh_, deeper) > 0.5 ? deeper : q).transpose();
                break;
            }
            out_.warnings.push_back("joint " + joint(static_cast<int>(j)).name + " was outside the surface and has been moved in");
        }
    }

    void measure_radii() {
        for (std::size_t j = 0; j < template_.joints.size(); ++j) {
            const int parent = template_.joints[j].parent;
            int other = parent;
            if (parent < 0)
                for (std::size_t k = template_.joints.size(); k-- > 0;)
                    if (template_.joints[k].parent == static_cast<int>(j)) other = static_cast<int>(k);
            const Vector3<double> p = at(static_cast<int>(j));
            const auto section = slicer_.around(p, (p - at(other)).normalized(), scale_ * 0.1);
            if (section) out_.radii[static_cast<Eigen::Index>(j)] = section->thickness;
        }
    }

    const TriangleMesh<double>& mesh_;
    Triangles adjacency_;
    Slicer slicer_;
    const CurveSkeleton<double>& curve_;
    const Embedding& embedding_;
    const SkeletonTemplate& template_;
    RefinementOptions options_;
    double scale_; ///< rest-pose length to body length
    std::vector<Limb> limbs_;
    RefinedJoints out_;
};

} // namespace

RefinedJoints refine(const TriangleMesh<double>& mesh, const std::vector<EndPoint>& ends,
                     const CurveSkeleton<double>& curve, const Embedding& embedding,
                     const SkeletonTemplate& skeleton_template, const RefinementOptions& options) {
    return Refiner(mesh, ends, curve, embedding, skeleton_template, options).run();
}

} // namespace skelgen
