#pragma once

#include <skelgen/fit_skeleton.hpp>

#include <cstddef>
#include <string>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/prepare.hpp>

namespace skelgen {

template <typename Scalar>
Extraction<Scalar> fit_skeleton(TriangleMesh<Scalar> mesh, KinematicSkeleton<Scalar> skeleton,
                                const ExtractOptions& options) {
    validate(options);
    const core::ThreadScope threads(options.threads);
    Extraction<Scalar> out;
    out.skeleton_template = builtin_template(skeleton.template_name);
    bool has_its_joints = skeleton.joints.size() == out.skeleton_template.joints.size();
    for (std::size_t j = 0; has_its_joints && j < skeleton.joints.size(); ++j)
        has_its_joints = skeleton.joints[j].name == out.skeleton_template.joints[j].name &&
                         skeleton.joints[j].parent == out.skeleton_template.joints[j].parent;
    if (!has_its_joints)
        throw Error(ErrorCode::bad_input, "the skeleton's joints are not those of the template " +
                                              skeleton.template_name + "; write it with `skelgen extract`");
    const auto material = surface::gather(mesh, options.prepare);
    if (material.bodies > 1 && options.prepare.component == 0)
        throw NoSkeleton(surface::several_bodies(material.bodies), {});
    std::size_t most = 0, joints = 0;
    for (const Joint<Scalar>& joint : skeleton.joints) joints += joint.is_present ? 1 : 0;
    for (const surface::Remedy remedy : material.remedies) {
        Outcome<Body<Scalar>> body = surface::make_body_by(remedy, material, options.prepare);
        if (!body) continue;
        std::size_t inside = 0;
        for (const Joint<Scalar>& joint : skeleton.joints)
            if (joint.is_present && surface::is_inside(*body, body->similarity.to_canonical(joint.position))) ++inside;
        if (inside > most) {
            most = inside;
            out.body = *std::move(body);
        }
        if (most == joints) break;
    }
    if (2 * most < joints)
        throw Error(
            ErrorCode::bad_input,
            "most of the skeleton's joints do not lie in the body; it must be of this mesh, in its coordinates");
    out.skeleton = std::move(skeleton);
    out.geodesic_diameter = out.body.similarity.scale * core::geodesic_diameter(out.body.graph);
    out.mesh = std::move(mesh);
    return out;
}

} // namespace skelgen
