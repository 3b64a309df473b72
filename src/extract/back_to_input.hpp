#pragma once

#include <unordered_set>
#include <vector>

#include <skelgen/core/canonical_form.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>

namespace skelgen::detail {

/// From the pipeline's canonical coordinates back to the caller's.
template <typename Scalar>
class BackToInput {
public:
    explicit BackToInput(const Similarity& similarity) : similarity_(similarity) {}

    [[nodiscard]] Vector3<Scalar> point(const Vector3<double>& p) const {
        return similarity_.to_input(p).template cast<Scalar>();
    }
    [[nodiscard]] Vector3<Scalar> direction(const Vector3<double>& d) const {
        return (similarity_.rotation.transpose() * d).template cast<Scalar>();
    }
    [[nodiscard]] Scalar length(double l) const { return static_cast<Scalar>(similarity_.scale * l); }

    [[nodiscard]] KinematicSkeleton<Scalar> skeleton(const KinematicSkeleton<double>& s) const {
        KinematicSkeleton<Scalar> out;
        out.template_name = s.template_name;
        for (const Joint<double>& joint : s.joints)
            out.joints.push_back(
                {joint.name, joint.parent, point(joint.position), length(joint.radius), joint.confidence});
        for (const auto& [name, p] : s.end_points) out.end_points.emplace_back(name, point(p));
        out.frame = {point(s.frame.origin), direction(s.frame.left), direction(s.frame.forward), direction(s.frame.up)};
        out.quality = s.quality;
        return out;
    }

    /// `source`: the caller's vertex behind each vertex of the regions. Where fans of faces touch, several stand for
    /// one of the caller's; it goes to the first region that has it.
    [[nodiscard]] CurveSkeleton<Scalar> curve(const CurveSkeleton<double>& c, const std::vector<int>& source) const {
        CurveSkeleton<Scalar> out;
        out.nodes.resize(c.nodes.rows(), 3);
        for (Eigen::Index v = 0; v < c.nodes.rows(); ++v)
            out.nodes.row(v) = point(c.nodes.row(v).transpose()).transpose();
        out.edges = c.edges;
        for (const double radius : c.radii) out.radii.push_back(length(radius));
        std::unordered_set<int> taken;
        for (const std::vector<int>& region : c.regions) {
            std::vector<int>& vertices = out.regions.emplace_back();
            for (const int v : region) {
                const int vertex = source[static_cast<std::size_t>(v)];
                if (vertex >= 0 && taken.insert(vertex).second) vertices.push_back(vertex);
            }
        }
        return out;
    }

private:
    const Similarity& similarity_;
};

} // namespace skelgen::detail
