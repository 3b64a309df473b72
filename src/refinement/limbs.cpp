#include <skelgen/refinement/limbs.hpp>

#include <algorithm>

#include <skelgen/core/polyline.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen {
namespace {

/// The geodesic diameter of a body (toe to fingertip over the surface) as a part of the longest path along the bones of
/// its skeleton. Calibrated: mean over 50 adults in 10 poses each.
constexpr double diameter_of_longest_path = 0.92;

/// A section this much larger than the limb's own is no longer the limb's: it has run into the trunk, or into the other
/// leg (a thigh or an upper arm widens by half at most from its middle to its top).
constexpr double attachment_growth = 1.7;

/// Arc length where the limb leaves the trunk, looking inwards from `own` away from the tip; the reference is the mean
/// section over the `stretch` before that.
double find_attachment(const Centreline& line, double own, double stretch) {
    const Eigen::Index last = line.arc.size() - 1;
    double sum = 0, count = 0;
    for (Eigen::Index i = last; i >= 1; --i) {
        const double from_tip = line.arc[last] - line.arc[i];
        if (line.area[i] <= 0 || from_tip < own - stretch) continue;
        if (from_tip <= own) {
            sum += line.area[i];
            count += 1;
        } else if (count > 0 && line.area[i] > attachment_growth * sum / count) {
            return line.arc[i + 1];
        }
    }
    return line.arc[0];
}

/// Centres of the rings around a limb, from `length` away from its end down to the end itself. Each is looked for near
/// the last one: where the end touches another part of the body, that has rings at the same distance.
Points<double> ring_centres(const Slicer& slicer, const EndPoint& end, double length, double step) {
    const Eigen::VectorXd field = end.distance.cwiseMin(2 * length + 1);
    std::vector<Vector3<double>> centres{slicer.mesh().vertices.row(end.vertex).transpose()};
    const int rings = static_cast<int>(std::ceil(length / step - 0.5));
    for (int ring = rings; ring-- > 0;)
        if (const auto centre = slicer.level_set_centre(field, length - ring * step, centres.back(), 2 * step))
            centres.push_back(*centre);
    Points<double> out(static_cast<Eigen::Index>(centres.size()), 3);
    for (std::size_t i = 0; i < centres.size(); ++i)
        out.row(out.rows() - 1 - static_cast<Eigen::Index>(i)) = centres[i].transpose();
    return out;
}

/// The limb's first bone is surely the limb's own up to its middle; nearer its outer joint, a folded elbow or knee
/// widens the sections.
double attachment_of(const Limb& limb) {
    const double top = limb.from_tip.front(), next = limb.from_tip.size() > 1 ? limb.from_tip[1] : 0;
    return find_attachment(limb.line, next + 0.5 * (top - next), 0.3 * (top - next));
}

/// The joints of the limb that `end` ends, outwards, without the one it branches off from.
std::vector<int> limb_joints(const SkeletonTemplate& skeleton_template, int end) {
    std::vector<int> children(skeleton_template.joints.size(), 0);
    for (const TemplateJoint& joint : skeleton_template.joints)
        if (joint.parent >= 0) ++children[static_cast<std::size_t>(joint.parent)];
    std::vector<int> joints;
    for (int j = end; j >= 0 && (j == end || children[static_cast<std::size_t>(j)] == 1);
         j = skeleton_template.joints[static_cast<std::size_t>(j)].parent)
        joints.insert(joints.begin(), j);
    return joints;
}

} // namespace

double template_scale(const SkeletonTemplate& skeleton_template, double geodesic_diameter) {
    return geodesic_diameter / (diameter_of_longest_path * longest_path(skeleton_template));
}

void draw_limb(Limb& limb, const Slicer& slicer, const EndPoint& end, const CentrelineOptions& options) {
    limb.line = draw_centreline(slicer, ring_centres(slicer, end, 1.05 * limb.from_tip.front(), options.step), options);
    limb.attachment = attachment_of(limb);
}

std::vector<Limb> trace_limbs(const Slicer& slicer, const std::vector<EndPoint>& ends,
                              const SkeletonTemplate& skeleton_template, double scale,
                              const CentrelineOptions& options) {
    std::vector<Limb> limbs;
    for (const EndPoint& end_point : ends) {
        const TemplateJoint& end = skeleton_template.joints[static_cast<std::size_t>(end_point.joint)];
        Limb limb;
        limb.joints = limb_joints(skeleton_template, end_point.joint);
        limb.from_tip.resize(limb.joints.size());
        double distance = end.tip ? (*end.tip - end.position).norm() : 0;
        for (std::size_t i = limb.joints.size(); i-- > 0;) {
            limb.from_tip[i] = scale * distance;
            const TemplateJoint& joint = skeleton_template.joints[static_cast<std::size_t>(limb.joints[i])];
            const TemplateJoint& parent = skeleton_template.joints[static_cast<std::size_t>(joint.parent)];
            distance += (joint.position - parent.position).norm();
        }
        draw_limb(limb, slicer, end_point, options);
        limbs.push_back(std::move(limb));
    }
    return limbs;
}

} // namespace skelgen
