#include <skelgen/io/view_page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include <skelgen/applications/curve_skin.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "base64.hpp"
#include "json_values.hpp"

namespace skelgen::io {
namespace {

using applications::Rig;
using detail::Json;

/// From the input's coordinates to the rig's, in steps: whole numbers are short, and a hundred thousandth of a body is
/// finer than any screen.
class ToRig {
public:
    ToRig(const KinematicSkeleton<double>& skeleton, const Rig<double>& rig) {
        const auto count = static_cast<Eigen::Index>(skeleton.joints.size());
        if (skeleton.joints.size() > rig.joints.size())
            throw Error(ErrorCode::usage, "the rig was made of another skeleton");
        Eigen::Matrix3Xd from(3, count), to(3, count);
        for (Eigen::Index j = 0; j < count; ++j) {
            from.col(j) = skeleton.joints[static_cast<std::size_t>(j)].position;
            to.col(j) = rig.joints[static_cast<std::size_t>(j)].position;
        }
        transform_ = Eigen::umeyama(from, to);
        const double size = (to.rowwise().maxCoeff() - to.rowwise().minCoeff()).norm();
        if (!((transform_ * from - to).cwiseAbs().maxCoeff() < 1e-6 * size))
            throw Error(ErrorCode::usage, "the rig is in another pose than its skeleton");
        step_ = 1e-5 * size;
    }

    [[nodiscard]] Json point(const Eigen::Vector3d& p) const { return in_steps(transform_ * p); }

    [[nodiscard]] Json in_steps(const Eigen::Vector3d& p) const {
        const auto steps = [&](double x) { return std::llround(x / step_); };
        return {steps(p[0]), steps(p[1]), steps(p[2])};
    }

    [[nodiscard]] double step() const { return step_; }

    /// Of length 1.
    [[nodiscard]] Json direction(const Eigen::Vector3d& d) const {
        const Eigen::Vector3d turned = (transform_.linear() * d).normalized();
        return {turned[0], turned[1], turned[2]};
    }

    /// The way back, as three rows of four.
    [[nodiscard]] Json to_input() const {
        const Eigen::Matrix4d back = transform_.inverse().matrix();
        Json rows = Json::array();
        for (Eigen::Index i = 0; i < 3; ++i) rows.push_back({back(i, 0), back(i, 1), back(i, 2), back(i, 3)});
        return rows;
    }

private:
    Eigen::Affine3d transform_;
    double step_ = 1;
};

Json joints_to_json(const ViewedBody& body, const ToRig& to_rig) {
    Json joints = Json::array();
    for (std::size_t j = 0; j < body.rig.joints.size(); ++j) {
        const applications::RigJoint<double>& joint = body.rig.joints[j];
        joints.push_back(
            {{"name", joint.name},
             {"side", joint.side == Side::left    ? "left"
                      : joint.side == Side::right ? "right"
                                                  : "none"},
             {"confidence", j < body.skeleton.joints.size() ? body.skeleton.joints[j].confidence : joint.confidence},
             {"end", to_rig.in_steps(joint.end)}});
    }
    return joints;
}

Json curve_to_view(const ViewedBody& body, const ToRig& to_rig) {
    const applications::Skin<double> skin =
        applications::curve_skin(body.curve, body.rig.skin, static_cast<int>(body.rig.joints.size()));
    Json nodes = Json::array(), joints = Json::array(), weights = Json::array();
    for (Eigen::Index i = 0; i < body.curve.nodes.rows(); ++i) {
        nodes.push_back(to_rig.point(core::point(body.curve.nodes, i)));
        Json node_joints = Json::array(), node_weights = Json::array();
        for (int k = 0; k < applications::Skin<double>::influences; ++k) {
            node_joints.push_back(skin.joints(i, k));
            node_weights.push_back(std::round(1e4 * skin.weights(i, k)) / 1e4);
        }
        joints.push_back(std::move(node_joints));
        weights.push_back(std::move(node_weights));
    }
    return {{"nodes", std::move(nodes)},
            {"edges", body.curve.edges},
            {"joints", std::move(joints)},
            {"weights", std::move(weights)}};
}

Json sections_to_json(const ViewedBody& body, const ToRig& to_rig) {
    Json sections = Json::array();
    for (const applications::BoneSection<double>& section : body.sections) {
        Json points = Json::array();
        for (const Eigen::Vector3d& point : section.points) points.push_back(to_rig.point(point));
        sections.push_back({{"joint", section.joint}, {"points", std::move(points)}});
    }
    return sections;
}

bool has_looks(const SceneLooks& looks) {
    return detail::parse_json(looks.json).contains("materials") ||
           std::any_of(looks.parts.begin(), looks.parts.end(),
                       [](const ScenePart& part) { return part.colours.rows() > 0; });
}

} // namespace

std::string viewed_body_to_json(const ViewedBody& body) {
    const ToRig to_rig(body.skeleton, body.rig);
    SceneLooks looks = body.looks;
    looks.objects.clear(); // the page shows one mesh, as it is
    const BodyFrame<double>& frame = body.skeleton.frame;
    Json warnings = Json::array();
    for (const std::string& warning : body.skeleton.quality.warnings) warnings.push_back(detail::valid_utf8(warning));
    const Json json{{"name", detail::valid_utf8(body.name)},
                    {"faces", body.rig.mesh.faces.rows()},
                    {"in_metres", body.rig.unit_is_known},
                    {"sides_confidence", body.skeleton.quality.sides_confidence},
                    {"warnings", std::move(warnings)},
                    {"step", to_rig.step()},
                    {"skeleton", detail::parse_json(skeleton_to_json(body.skeleton, {body.source, std::nullopt}))},
                    {"to_input", to_rig.to_input()},
                    {"joints", joints_to_json(body, to_rig)},
                    {"frame",
                     {{"left", to_rig.direction(frame.left)},
                      {"up", to_rig.direction(frame.up)},
                      {"forward", to_rig.direction(frame.forward)}}},
                    {"curve", curve_to_view(body, to_rig)},
                    {"sections", sections_to_json(body, to_rig)},
                    {"has_looks", has_looks(body.looks)},
                    {"glb", detail::encode_base64(rig_to_glb(body.rig, JointNames::skelgen, looks, body.animations))}};
    return json.dump();
}

std::string refused_body_to_json(const std::string& name, const std::string& failure,
                                 const TriangleMesh<double>& mesh) {
    Json json{
        {"name", detail::valid_utf8(name)}, {"faces", mesh.faces.rows()}, {"failure", detail::valid_utf8(failure)}};
    if (mesh.faces.rows() > 0) json["glb"] = detail::encode_base64(format_mesh(mesh, MeshFormat::glb));
    return json.dump();
}

std::string view_page(std::string_view page_template, const std::vector<std::string>& bodies) {
    constexpr std::string_view element = R"(<script id="bodies" type="application/json">)";
    const std::size_t found = page_template.find(element);
    if (found == std::string_view::npos)
        throw Error(ErrorCode::internal, "the page's template has no element for the bodies");
    const std::size_t place = found + element.size();
    std::string page(page_template.substr(0, place));
    page += '[';
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (i > 0) page += ",\n";
        for (const char c : bodies[i]) // what a name holds must not end the element; strings alone have this character
            if (c == '<')
                page += "\\u003c";
            else
                page += c;
    }
    page += ']';
    page += page_template.substr(place);
    return page;
}

} // namespace skelgen::io
