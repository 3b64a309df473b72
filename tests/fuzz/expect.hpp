#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/io/scene_looks.hpp>

#include "io/glb_writer.hpp"

/// What all fuzz targets share. A target is one reader: whatever the bytes, it gives a sound value or an Error about
/// the input; anything else ends the run as a finding.
namespace skelgen::fuzz {

inline void expect(bool condition) {
    if (!condition) std::abort();
}

inline void expect_sound(const TriangleMesh<double>& mesh) {
    expect(mesh.faces.rows() > 0 && mesh.vertices.allFinite());
    expect(mesh.faces.minCoeff() >= 0 && mesh.faces.maxCoeff() < mesh.vertices.rows());
}

/// Whether a mesh's looks can be written with it: as GLB, and as the VRM of a rig whose root moves all.
inline void expect_looks_of(const TriangleMesh<double>& mesh, const io::SceneLooks& looks) {
    if (mesh.vertices.cwiseAbs().maxCoeff() > 1e30) return; // beyond single precision, or near it
    const auto count = static_cast<std::size_t>(mesh.vertices.rows());
    applications::Rig<double> rig;
    rig.mesh = mesh;
    rig.rest = applications::RestPose::t_pose;
    rig.turns.assign(count, Eigen::Quaterniond::Identity());
    static_cast<void>(io::detail::format_glb(mesh, looks, rig.turns));
    for (const TemplateJoint& joint : builtin_template("human21").joints)
        rig.joints.push_back({joint.name, joint.parent, joint.role, joint.side, joint.position});
    rig.motions.resize(rig.joints.size());
    rig.skin.joints.setZero(mesh.vertices.rows(), applications::Skin<double>::influences);
    rig.skin.weights.setZero(mesh.vertices.rows(), applications::Skin<double>::influences);
    rig.skin.weights.col(0).setOnes();
    static_cast<void>(io::rig_to_vrm(rig, "avatar", looks));
    static_cast<void>(io::rig_to_fbx(rig, io::JointNames::skelgen, looks));
    static_cast<void>(io::left_out_of(io::RigFormat::fbx, looks));
    static_cast<void>(io::left_out_of(io::RigFormat::vrm, looks));
}

/// Gives the bytes to `read`; the value is for libFuzzer.
template <typename Read>
int run(const std::uint8_t* data, std::size_t size, const Read& read) {
    try {
        read(std::string_view(reinterpret_cast<const char*>(data), size));
    } catch (const Error& error) {
        expect(error.code() == ErrorCode::bad_input);
    }
    return 0;
}

} // namespace skelgen::fuzz
