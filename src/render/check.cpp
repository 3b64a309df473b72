#include "check.hpp"

#include <algorithm>

#include <skelgen/core/error.hpp>

namespace skelgen::render {
namespace {

void check_size(int pixels) {
    if (pixels < 16 || pixels > 16384)
        throw Error(ErrorCode::usage, "a picture must be 16 to 16384 pixels wide and high: " + std::to_string(pixels) +
                                          " is out of range");
}

void check(const TriangleMesh<double>& mesh) {
    if (!mesh.vertices.allFinite()) throw Error(ErrorCode::bad_input, "the mesh has coordinates that are not finite");
    if (mesh.faces.size() == 0) return;
    if (mesh.faces.minCoeff() < 0 || mesh.faces.maxCoeff() >= mesh.vertices.rows())
        throw Error(ErrorCode::bad_input, "the mesh has a face with a corner that is none of its vertices");
}

void check(const CurveSkeleton<double>& curve) {
    if (!curve.nodes.allFinite())
        throw Error(ErrorCode::bad_input, "the curve skeleton has coordinates that are not finite");
    for (const auto& [first, second] : curve.edges)
        if (std::min(first, second) < 0 || std::max(first, second) >= curve.nodes.rows())
            throw Error(ErrorCode::bad_input, "the curve skeleton has an edge to a node that does not exist");
}

void check(const KinematicSkeleton<double>& skeleton) {
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
        const auto& joint = skeleton.joints[i];
        if (!joint.position.allFinite())
            throw Error(ErrorCode::bad_input, "the joint '" + joint.name + "' has a position that is not finite");
        if (joint.parent >= static_cast<int>(i))
            throw Error(ErrorCode::bad_input, "the joint '" + joint.name + "' comes before its parent");
    }
    for (const auto& [name, position] : skeleton.end_points)
        if (!position.allFinite())
            throw Error(ErrorCode::bad_input, "the end point '" + name + "' has a position that is not finite");
}

} // namespace

void check(const RenderOptions& options) {
    check_size(options.width);
    check_size(options.height);
    if (options.supersampling < 1 || options.supersampling > 8)
        throw Error(ErrorCode::usage, "supersampling must be 1 to 8");
}

void check(const Scene& scene) {
    check(scene.mesh);
    if (!scene.colours.empty() && scene.colours.size() != static_cast<std::size_t>(scene.mesh.vertices.rows()))
        throw Error(ErrorCode::bad_input, "a coloured body needs a colour for each of its vertices");
    if (scene.curve) check(*scene.curve);
    if (scene.skeleton) check(*scene.skeleton);
    for (const Mark& mark : scene.marks)
        if (!mark.position.allFinite())
            throw Error(ErrorCode::bad_input, "the mark '" + mark.name + "' has a position that is not finite");
}

} // namespace skelgen::render
