#include <skelgen/refinement/limbs.hpp>

#include <algorithm>

#include <skelgen/core/polyline.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen {
namespace {

/// The geodesic diameter of a body (toe to fingertip over the surface) as a part of the longest path along the bones of
/// its skeleton. Calibrated: mean over 50 adults in 10 poses each.
constexpr double diameter_of_longest_path = 0.95;

/// A section that grows by this factor within a few steps is no longer the limb's own: it has run into the trunk, or into
/// the other leg.
constexpr double attachment_growth = 1.5;
constexpr Eigen::Index attachment_steps = 4;

double find_attachment(const Centreline& line, double outer_part) {
    const Eigen::Index n = line.points.rows();
    for (Eigen::Index i = n - 2; i >= 1; --i) {
        if (line.arc[n - 1] - line.arc[i] < outer_part) continue;
        double largest = 0;
        for (Eigen::Index k = i + 1; k <= std::min(i + attachment_steps, n - 2); ++k)
            largest = std::max(largest, line.area[k]);
        if (largest > 0 && (line.area[i] == 0 || line.area[i] > attachment_growth * largest)) return line.arc[i + 1];
    }
    return line.arc[0];
}

} // namespace

double template_scale(const SkeletonTemplate& skeleton_template, double geodesic_diameter) {
    return geodesic_diameter / (diameter_of_longest_path * longest_path(skeleton_template));
}

std::vector<Limb> trace_limbs(const Slicer& slicer, const CurveSkeleton<double>& curve, const Embedding& embedding,
                              const SkeletonTemplate& skeleton_template, double scale,
                              const CentrelineOptions& options) {
    std::vector<Limb> limbs;
    for (const Chain& chain : embedding.chains) {
        const TemplateJoint& end = skeleton_template.joints[static_cast<std::size_t>(chain.joints.back())];
        if (end.role != JointRole::head && end.role != JointRole::hand && end.role != JointRole::foot) continue;
        Limb limb;
        limb.joints.assign(chain.joints.begin() + 1, chain.joints.end());
        limb.from_tip.resize(limb.joints.size());
        double distance = end.tip ? (*end.tip - end.position).norm() : 0;
        for (std::size_t i = limb.joints.size(); i-- > 0;) {
            limb.from_tip[i] = scale * distance;
            const TemplateJoint& joint = skeleton_template.joints[static_cast<std::size_t>(limb.joints[i])];
            const TemplateJoint& parent = skeleton_template.joints[static_cast<std::size_t>(joint.parent)];
            distance += (joint.position - parent.position).norm();
        }
        Points<double> path(static_cast<Eigen::Index>(chain.nodes.size()), 3);
        for (std::size_t i = 0; i < chain.nodes.size(); ++i)
            path.row(static_cast<Eigen::Index>(i)) = curve.nodes.row(chain.nodes[i]);
        limb.line = draw_centreline(slicer, path, options);
        limb.attachment = find_attachment(limb.line, 0.6 * limb.from_tip.front());
        limbs.push_back(std::move(limb));
    }
    return limbs;
}

} // namespace skelgen
