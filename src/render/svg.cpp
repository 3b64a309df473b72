#include <skelgen/render/render_scene.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <skelgen/render/png.hpp>

#include "body.hpp"
#include "check.hpp"
#include "drawing.hpp"
#include "io/base64.hpp"
#include "xml_text.hpp"

namespace skelgen::render {
namespace {

std::string hex(const Colour& colour) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", to_byte(colour.red), to_byte(colour.green), to_byte(colour.blue));
    return text;
}

Colour darker(const Colour& colour) { return {0.6f * colour.red, 0.6f * colour.green, 0.6f * colour.blue}; }

std::string pair(const Eigen::Vector2d& p) { return decimal(p.x()) + " " + decimal(p.y()); }

std::string attribute(const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + value + "\"";
}

std::string paint(const RoundCone& cone) {
    const double rim = std::max(0.25, 0.16 * std::max(cone.start_radius, cone.end_radius));
    return attribute("fill", hex(cone.colour)) + attribute("stroke", hex(darker(cone.colour))) +
           attribute("stroke-width", decimal(rim)) + "/>\n";
}

std::string circle(const RoundCone& cone) {
    return "<circle" + attribute("cx", decimal(cone.end.x())) + attribute("cy", decimal(cone.end.y())) +
           attribute("r", decimal(std::max(cone.start_radius, cone.end_radius))) + paint(cone);
}

std::string arc_to(double radius, const Eigen::Vector2d& end) {
    return "A" + decimal(radius) + " " + decimal(radius) + " 0 0 1 " + pair(end);
}

std::string capsule(const RoundCone& cone) {
    const Eigen::Vector2d start = cone.start.head<2>();
    const Eigen::Vector2d end = cone.end.head<2>();
    const Eigen::Vector2d along = (end - start).normalized();
    const Eigen::Vector2d across(along.y(), -along.x());
    const std::string path =
        "M" + pair(start + cone.start_radius * across) + "L" + pair(end + cone.end_radius * across) +
        arc_to(cone.end_radius, end - cone.end_radius * across) + "L" + pair(start - cone.start_radius * across) +
        arc_to(cone.start_radius, start + cone.start_radius * across) + "Z";
    return "<path" + attribute("d", path) + paint(cone);
}

std::string element(const RoundCone& cone) {
    const bool seen_end_on = (cone.end - cone.start).head<2>().norm() < 0.01;
    return seen_end_on ? circle(cone) : capsule(cone);
}

std::string element(const OverlayLine& line, double width, const Colour& colour) {
    std::string points;
    for (const Eigen::Vector2d& p : line.points) points += (points.empty() ? "" : " ") + pair(p);
    return "<polyline" + attribute("points", points) + attribute("fill", "none") + attribute("stroke", hex(colour)) +
           attribute("stroke-width", decimal(width)) + "/>\n";
}

std::string element(const OverlayText& text) {
    const char* anchors[] = {"start", "middle", "end"}; // in the order of Anchor
    return "<text" + attribute("x", decimal(text.baseline.x())) + attribute("y", decimal(text.baseline.y())) +
           attribute("font-size", decimal(text.cap_height / 0.72)) + // sans-serif capitals are 0.72 em high
           attribute("text-anchor", anchors[static_cast<std::size_t>(text.anchor)]) +
           attribute("fill", hex(text.colour)) + ">" + xml_text(text.text) + "</text>\n";
}

std::string body_image(const Scene& scene, const Drawing& drawing, RenderOptions options) {
    options.background = Background::transparent;
    const Image body = draw_body(scene, drawing.projection, {}, options);
    return "<image" + attribute("width", std::to_string(options.width)) +
           attribute("height", std::to_string(options.height)) +
           attribute("href", "data:image/png;base64," + io::detail::encode_base64(encode_png(body))) + "/>\n";
}

/// The farthest first, so that later elements cover earlier ones.
std::vector<RoundCone> by_depth(std::vector<RoundCone> cones) {
    std::stable_sort(cones.begin(), cones.end(), [](const RoundCone& a, const RoundCone& b) {
        return a.start.z() + a.end.z() < b.start.z() + b.end.z();
    });
    return cones;
}

std::string opening_tag(const RenderOptions& options) {
    const std::string width = std::to_string(options.width);
    const std::string height = std::to_string(options.height);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) + attribute("height", height) +
           attribute("viewBox", "0 0 " + width + " " + height) + attribute("font-family", "sans-serif") +
           attribute("stroke-linecap", "round") + attribute("stroke-linejoin", "round") + ">\n";
}

} // namespace

std::string render_svg(const Scene& scene, const RenderOptions& options) {
    check(options);
    check(scene);
    const Drawing drawing = lay_out(scene, options);
    std::string svg = opening_tag(options);
    if (options.background == Background::white) svg += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    if (scene.mesh.faces.rows() > 0) svg += body_image(scene, drawing, options);
    for (const RoundCone& cone : by_depth(drawing.cones)) svg += element(cone);
    for (const OverlayLine& line : drawing.lines)
        if (line.halo) svg += element(line, 2.2 * line.width + 1, palette::halo);
    for (const OverlayLine& line : drawing.lines) svg += element(line, line.width, line.colour);
    for (const OverlayText& text : drawing.texts) svg += element(text);
    return svg + "</svg>\n";
}

} // namespace skelgen::render
