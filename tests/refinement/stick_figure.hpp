#pragma once

// A body whose bones are those of human21 at rest, and the curve and embedding that belong to it.

#include <cmath>
#include <limits>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/surface/body.hpp>

#include "limb_shapes.hpp"
#include "shapes.hpp"

namespace skelgen::test {

/// The bones of a template as a curve, node j being joint j and the tips after the joints, and the embedding that
/// follows. `positions` and `tips` (of joints that have one) say where the joints are.
template <typename Scalar>
struct BoneCurve {
    CurveSkeleton<Scalar> curve;
    embedding::Embedding embedding;
    std::vector<int> leaf; ///< per joint the node of its tip, -1 where it has none

    BoneCurve(const SkeletonTemplate& skeleton_template, const std::vector<Vec3>& positions,
              const std::vector<Vec3>& tips) {
        const std::size_t n = skeleton_template.joints.size();
        curve.nodes.resize(static_cast<Eigen::Index>(n), 3);
        leaf.assign(n, -1);
        embedding.node_of_joint.resize(n);
        for (std::size_t j = 0; j < n; ++j) {
            curve.nodes.row(static_cast<Eigen::Index>(j)) = positions[j].transpose().cast<Scalar>();
            if (skeleton_template.joints[j].parent >= 0)
                curve.edges.push_back({skeleton_template.joints[j].parent, static_cast<int>(j)});
            embedding.node_of_joint[j] = static_cast<int>(j);
        }
        for (std::size_t j = 0; j < n; ++j) {
            if (!skeleton_template.joints[j].tip) continue;
            leaf[j] = static_cast<int>(curve.nodes.rows());
            curve.nodes.conservativeResize(leaf[j] + 1, 3);
            curve.nodes.row(leaf[j]) = tips[j].transpose().cast<Scalar>();
            curve.edges.push_back({static_cast<int>(j), leaf[j]});
            embedding::Chain chain; // from the joint that branches to the tip
            for (int k = static_cast<int>(j); k >= 0; k = skeleton_template.joint(k).parent) {
                chain.joints.insert(chain.joints.begin(), k);
                const JointRole role = skeleton_template.joint(k).role;
                if (role == JointRole::chest || role == JointRole::pelvis) break;
            }
            chain.nodes = chain.joints;
            chain.nodes.push_back(leaf[j]);
            embedding.chains.push_back(chain);
        }
        const int chest = find_joint(skeleton_template, JointRole::chest);
        embedding::Chain trunk;
        for (int k = chest; k >= 0; k = skeleton_template.joint(k).parent) trunk.joints.insert(trunk.joints.begin(), k);
        trunk.nodes = trunk.joints;
        embedding.chains.push_back(trunk);
        curve.regions.resize(static_cast<std::size_t>(curve.nodes.rows()));
        curve.radii.assign(static_cast<std::size_t>(curve.nodes.rows()), Scalar(0.05));
    }
};

/// human21 at rest with tubes around its bones: thick around trunk and head, thin around the limbs.
template <typename Scalar>
struct StickFigure {
    static constexpr double step = 0.03; ///< of the mesh
    Body<Scalar> body;
    CurveSkeleton<Scalar> curve;
    embedding::Embedding embedding;

    StickFigure() {
        const SkeletonTemplate& human = builtin_template("human21");
        std::vector<Vec3> positions, tips;
        for (const TemplateJoint& joint : human.joints) {
            positions.push_back(joint.position);
            tips.push_back(joint.tip.value_or(Vec3::Zero()));
        }
        const BoneCurve<Scalar> bones(human, positions, tips);
        curve = bones.curve;
        embedding = bones.embedding;
        leaf_ = bones.leaf;
        body = body_of<Scalar>(mesh());
    }

    /// Of the tube around the bone that ends in a joint of that role, and around what is beyond it.
    [[nodiscard]] static double radius(JointRole role) {
        return role == JointRole::head ? 0.09 : part_of(role) == BodyPart::trunk ? 0.12 : 0.05;
    }

    [[nodiscard]] int leaf_of(int joint) const { return leaf_[static_cast<std::size_t>(joint)]; }

private:
    std::vector<int> leaf_;

    static const Mesh& mesh() {
        static const Mesh made = [] {
            const SkeletonTemplate& human = builtin_template("human21");
            const auto field = [&](const Vec3& p) {
                double nearest = std::numeric_limits<double>::infinity();
                for (const TemplateJoint& joint : human.joints) {
                    const double r = radius(joint.role);
                    if (joint.parent >= 0)
                        nearest = std::min(nearest,
                                           segment_distance(p, joint.position, human.joint(joint.parent).position) - r);
                    if (joint.tip) nearest = std::min(nearest, segment_distance(p, joint.position, *joint.tip) - r);
                }
                return nearest;
            };
            return level_set(field, Vec3(-1, -0.08, -0.2), Vec3(1, 1.9, 0.27), step);
        }();
        return made;
    }
};

} // namespace skelgen::test
