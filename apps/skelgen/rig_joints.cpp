#include "rig_joints.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/applications/clip_body.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/extract_hinted.hpp>
#include <skelgen/io/read_clip.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::cli {
namespace {

/// The joints of limbs, neck and head that a rig's names tell; the trunk's are wherever its maker likes to have them.
std::vector<Hint> joints_of_rig(const MeshInput& input) {
    const auto clip = io::read_rig(input.file, input.options);
    if (!clip) throw Error(ErrorCode::bad_input, "has no rig; leave --use-rig out");
    const auto body = applications::find_body(*clip);
    if (!body) throw Error(ErrorCode::bad_input, "its rig: " + body.failure().what + "; leave --use-rig out");
    const auto positions = applications::rest_pose(*clip).positions;
    std::vector<Hint> out;
    const auto add = [&](const std::string& name, int joint) {
        if (joint >= 0) out.push_back({name, positions[static_cast<std::size_t>(joint)]});
    };
    add("head", body->head);
    if (!body->neck.empty()) add("neck", body->neck.front());
    for (const std::size_t side : {0U, 1U}) {
        const std::string prefix = side == 0 ? "left_" : "right_";
        const applications::ClipLimb &arm = body->arms[side], &leg = body->legs[side];
        add(prefix + "shoulder", arm.upper);
        add(prefix + "elbow", arm.lower);
        add(prefix + "wrist", arm.end);
        add(prefix + "hand", arm.tip);
        add(prefix + "hip", leg.upper);
        add(prefix + "knee", leg.lower);
        add(prefix + "ankle", leg.end);
        add(prefix + "foot", leg.tip);
    }
    return out;
}

/// Per cent with a digit behind the point.
std::string per_cent(double part) {
    const auto tenths = std::lround(1000 * part);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " %";
}

} // namespace

Extraction<double> extract_with_rig(const MeshInput& input, const ExtractOptions& options) {
    constexpr double near = 0.03, alike = 0.1; // of the size
    constexpr std::size_t least = 8;
    std::vector<Hint> joints = joints_of_rig(input);
    TriangleMesh<double> mesh = load_mesh(input);
    const double size = core::bounding_diagonal(mesh.vertices);
    std::optional<Extraction<double>> own;
    try {
        own = extract_in(mesh, options);
    } catch (const NoSkeleton&) { // the rig may still tell
    }
    const std::size_t all = joints.size();
    std::erase_if(joints, [&](const Hint& joint) {
        if (own && surface::is_inside(own->body, own->body.similarity.to_canonical(joint.position))) return false;
        const double distance = (mesh.vertices.rowwise() - joint.position.transpose()).rowwise().norm().minCoeff();
        return !(distance <= near * size);
    });
    const std::string sound = std::to_string(joints.size()) + " of " + std::to_string(all) + " of its rig's joints";
    if (joints.size() < least) {
        if (!own)
            throw Error(ErrorCode::bad_input,
                        "only " + sound + " lie in the mesh, and without them no body is found; give a --skeleton");
        own->mesh = std::move(mesh);
        own->skeleton.quality.warnings.insert(own->skeleton.quality.warnings.begin(),
                                              "only " + sound + " lie in the body, so its rig is not used");
        return *std::move(own);
    }
    std::string said = sound + " are taken";
    double worst = 1;
    if (own) {
        std::vector<std::pair<double, std::string>> distances;
        for (const Hint& joint : joints) {
            const auto j = static_cast<std::size_t>(find_joint(own->skeleton, joint.joint));
            distances.emplace_back((own->skeleton.joints[j].position - joint.position).norm() / size, joint.joint);
        }
        std::sort(distances.begin(), distances.end());
        worst = distances.back().first;
        said += "; without them joints are found " + per_cent(distances[distances.size() / 2].first) +
                " of the size away from these, the farthest, " + distances.back().second + ", " + per_cent(worst);
    } else {
        said += "; without them no body is found";
    }
    Extraction<double> out;
    if (worst < alike) {
        out = *std::move(own);
        out.skeleton = bent_to(std::move(out.skeleton), out.skeleton_template, joints, size);
        out.mesh = std::move(mesh);
    } else {
        out = extract_hinted(std::move(mesh), joints, options);
    }
    out.skeleton.quality.warnings.insert(out.skeleton.quality.warnings.begin(), said);
    out.skeleton.quality.sides_confidence = 1; // the rig's maker answers for it
    return out;
}

} // namespace skelgen::cli
