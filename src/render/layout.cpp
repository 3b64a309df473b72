#include "drawing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <Eigen/Geometry>

#include "stroke_font.hpp"

namespace skelgen::render {
namespace {

using Box2 = Eigen::AlignedBox2d;

/// Sizes in pixels that follow from the size of the picture.
struct Sizes {
    double margin;
    double cap_height;
    double line_height;
};

Sizes sizes_of(const RenderOptions& options) {
    const double side = std::min(options.width, options.height);
    const double cap_height = std::clamp(0.0145 * side, 6.5, 40.0);
    return {0.045 * side, cap_height, 2.1 * cap_height};
}

bool starts_with(const std::string& text, const char* prefix) { return text.rfind(prefix, 0) == 0; }

Colour side_colour(const std::string& name) {
    if (starts_with(name, "left")) return palette::left;
    if (starts_with(name, "right")) return palette::right;
    return palette::middle;
}

// ---- captions ----

std::string shortened_to(const std::string& text, double width, double cap_height) {
    if (text_width(text, cap_height) <= width) return text;
    // The end of a path says more than its beginning.
    std::string_view tail = text;
    while (!tail.empty() && text_width("..." + std::string(tail), cap_height) > width) tail.remove_prefix(1);
    return "..." + std::string(tail);
}

std::vector<std::string> wrapped(const std::string& text, double width, double cap_height, std::size_t most_lines) {
    std::vector<std::string> lines(1);
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
        if (lines.back().empty() || text_width(longer, cap_height) <= width)
            lines.back() = longer;
        else if (lines.size() == most_lines) {
            lines.back() += " ...";
            break;
        } else
            lines.push_back(word);
        at = end + 1;
    }
    return lines;
}

/// Writes caption and failure above the lower edge; returns the height they take.
double add_captions(const Scene& scene, const RenderOptions& options, const Sizes& sizes, Drawing& drawing) {
    const double width = options.width - 2 * sizes.margin;
    std::vector<std::pair<std::string, Colour>> lines;
    if (!scene.caption.empty()) lines.emplace_back(shortened_to(scene.caption, width, sizes.cap_height), palette::text);
    if (!scene.failure.empty())
        for (std::string& line : wrapped(scene.failure, width, sizes.cap_height, 4))
            lines.emplace_back(std::move(line), palette::failure);
    if (lines.empty()) return 0;
    double y = options.height - sizes.margin - sizes.line_height * static_cast<double>(lines.size() - 1);
    for (auto& [text, colour] : lines) {
        drawing.texts.push_back({std::move(text), {options.width / 2.0, y}, Anchor::middle, sizes.cap_height, colour});
        y += sizes.line_height;
    }
    return sizes.line_height * static_cast<double>(lines.size());
}

void add_failure_frame(const RenderOptions& options, const Sizes& sizes, Drawing& drawing) {
    const double inset = sizes.margin / 3;
    const double right = options.width - inset;
    const double bottom = options.height - inset;
    drawing.lines.push_back({{{inset, inset}, {right, inset}, {right, bottom}, {inset, bottom}, {inset, inset}},
                             std::max(1.5, sizes.cap_height / 6),
                             palette::failure});
}

// ---- projection ----

double name_column(const Scene& scene, const Sizes& sizes) {
    double widest = 0;
    for (const auto& joint : scene.skeleton->joints)
        widest = std::max(widest, text_width(joint.name, sizes.cap_height));
    return widest + 3 * sizes.cap_height;
}

/// Bounds of all that the picture has to show, in the camera's axes (x right, y down, z toward).
Eigen::AlignedBox3d bounds_of(const Scene& scene, const Eigen::Matrix3d& turn) {
    Eigen::AlignedBox3d box;
    for (Eigen::Index i = 0; i < scene.mesh.vertices.rows(); ++i)
        box.extend(turn * scene.mesh.vertices.row(i).transpose());
    if (scene.skeleton)
        for (const auto& joint : scene.skeleton->joints)
            if (joint.is_present) box.extend(turn * joint.position);
    for (const Mark& mark : scene.marks) box.extend(turn * mark.position);
    return box;
}

Projection fit(const Scene& scene, const View& view, const Box2& frame) {
    const Camera camera = look_at(scene, view);
    Projection projection;
    projection.turn << camera.right.transpose(), -camera.up.transpose(), camera.toward.transpose();
    const Eigen::AlignedBox3d bounds = bounds_of(scene, projection.turn);
    if (bounds.isEmpty()) return projection;
    const Eigen::Vector3d size = bounds.sizes();
    const double tiny = std::numeric_limits<double>::min();
    const double scale =
        std::min(frame.sizes().x() / std::max(size.x(), tiny), frame.sizes().y() / std::max(size.y(), tiny));
    projection.scale = std::isfinite(scale) ? scale : 1; // a single point has no size
    const Eigen::Vector3d target(frame.center().x(), frame.center().y(), 0);
    projection.shift = target - projection.scale * bounds.center();
    return projection;
}

// ---- skeletons ----

/// Thicknesses in pixels for a picture that leaves `frame` to the body.
struct Thickness {
    double bone_start;
    double bone_end;
    double joint;
    double tip;
    double curve;
};

Thickness thickness_for(const Box2& frame) {
    const double size = std::max(frame.sizes().x(), frame.sizes().y());
    return {std::max(1.7, 0.0066 * size), std::max(1.0, 0.0034 * size), std::max(2.3, 0.0088 * size),
            std::max(1.2, 0.0042 * size), std::max(0.55, 0.0013 * size)};
}

/// How many edges end at each node.
std::vector<int> degrees(const CurveSkeleton<double>& curve) {
    std::vector<int> count(static_cast<std::size_t>(curve.nodes.rows()), 0);
    for (const auto& edge : curve.edges)
        for (const int node : edge) ++count[static_cast<std::size_t>(node)];
    return count;
}

void add_ball(const PixelPoint& centre, double radius, const Colour& colour, Drawing& drawing) {
    drawing.cones.push_back({centre, centre, radius, radius, colour});
}

/// The curve as thin lines, with dots where it ends or branches.
void add_curve(const CurveSkeleton<double>& curve, const Thickness& thickness, Drawing& drawing) {
    for (const auto& [first, second] : curve.edges)
        drawing.cones.push_back({drawing.projection(curve.nodes.row(first)),
                                 drawing.projection(curve.nodes.row(second)), thickness.curve, thickness.curve,
                                 palette::curve});
    const std::vector<int> degree = degrees(curve);
    for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i)
        if (degree[static_cast<std::size_t>(i)] != 2)
            add_ball(drawing.projection(curve.nodes.row(i)), 2.4 * thickness.curve, palette::curve, drawing);
}

void add_bones(const KinematicSkeleton<double>& skeleton, const Thickness& thickness, Drawing& drawing) {
    for (const auto& joint : skeleton.joints) {
        if (!joint.is_present) continue;
        const PixelPoint here = drawing.projection(joint.position);
        const Colour colour = side_colour(joint.name);
        if (joint.parent >= 0) {
            const auto& parent = skeleton.joints[static_cast<std::size_t>(joint.parent)];
            drawing.cones.push_back(
                {drawing.projection(parent.position), here, thickness.bone_start, thickness.bone_end, colour});
        }
        add_ball(here, thickness.joint, colour, drawing);
    }
    for (const auto& [name, position] : skeleton.end_points)
        add_ball(drawing.projection(position), thickness.tip, side_colour(name), drawing);
}

void add_marks(const std::vector<Mark>& marks, const Thickness& thickness, Drawing& drawing) {
    const double arm = std::max(2.5, 0.9 * thickness.joint);
    const double width = std::max(1.0, 0.25 * thickness.joint);
    for (const Mark& mark : marks) {
        const Eigen::Vector2d at = drawing.projection(mark.position).head<2>();
        for (const double sign : {1.0, -1.0}) {
            const Eigen::Vector2d reach(arm, sign * arm);
            drawing.lines.push_back({{at - reach, at + reach}, width, palette::mark, true});
        }
    }
}

// ---- names ----

/// Moves the sorted heights apart until each is `gap` from the next, as little as possible and within [top, bottom].
void spread(std::vector<double>& heights, double gap, double top, double bottom) {
    double lowest = top;
    for (double& y : heights) {
        y = std::max(y, lowest);
        lowest = y + gap;
    }
    double highest = bottom;
    for (auto y = heights.rbegin(); y != heights.rend(); ++y) {
        *y = std::min(*y, highest);
        highest = *y - gap;
    }
}

/// The names of `joints`, one below the other at `x`, each with a line to its joint.
void add_name_column(const KinematicSkeleton<double>& skeleton, std::vector<std::size_t> joints, double x,
                     Anchor anchor, const RenderOptions& options, const Sizes& sizes, Drawing& drawing) {
    const auto place = [&](std::size_t joint) { return drawing.projection(skeleton.joints[joint].position); };
    std::stable_sort(joints.begin(), joints.end(), [&](auto a, auto b) { return place(a).y() < place(b).y(); });
    std::vector<double> heights;
    for (const std::size_t joint : joints) heights.push_back(place(joint).y());
    spread(heights, sizes.line_height, 2 * sizes.margin, options.height - 2 * sizes.margin);
    const double toward_body = anchor == Anchor::start ? -1 : 1;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const std::string& name = skeleton.joints[joints[i]].name;
        const Eigen::Vector2d knee(x + toward_body * 0.7 * sizes.cap_height, heights[i]);
        drawing.lines.push_back(
            {{place(joints[i]).head<2>(), knee}, std::max(0.8, sizes.cap_height / 14), palette::leader, false});
        drawing.texts.push_back(
            {name, {x, heights[i] + sizes.cap_height / 2}, anchor, sizes.cap_height, palette::text});
    }
}

/// Each name on the side of the body that its joint is nearer to.
void add_names(const KinematicSkeleton<double>& skeleton, const Box2& frame, const RenderOptions& options,
               const Sizes& sizes, Drawing& drawing) {
    Box2 bounds;
    for (const auto& joint : skeleton.joints)
        if (joint.is_present) bounds.extend(Eigen::Vector2d(drawing.projection(joint.position).head<2>()));
    std::vector<std::size_t> left;
    std::vector<std::size_t> right;
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
        if (!skeleton.joints[i].is_present) continue;
        const double x = drawing.projection(skeleton.joints[i].position).x();
        (x < bounds.center().x() ? left : right).push_back(i);
    }
    const double gap = 1.5 * sizes.cap_height;
    add_name_column(skeleton, left, frame.min().x() - gap, Anchor::end, options, sizes, drawing);
    add_name_column(skeleton, right, frame.max().x() + gap, Anchor::start, options, sizes, drawing);
}

} // namespace

Drawing lay_out(const Scene& scene, const RenderOptions& options) {
    const Sizes sizes = sizes_of(options);
    Drawing drawing;
    const double caption_height = add_captions(scene, options, sizes, drawing);
    const bool names = options.names && scene.skeleton;
    const double side_margin = sizes.margin + (names ? name_column(scene, sizes) : 0);
    // Names never take more than two thirds of a narrow picture.
    const double left = std::min(side_margin, options.width / 3.0);
    const Box2 frame(Eigen::Vector2d(left, sizes.margin),
                     Eigen::Vector2d(options.width - left, options.height - sizes.margin - caption_height));
    drawing.projection = fit(scene, options.view, frame);

    const Thickness thickness = thickness_for(frame);
    if (scene.curve) add_curve(*scene.curve, thickness, drawing);
    if (scene.skeleton) add_bones(*scene.skeleton, thickness, drawing);
    if (names) add_names(*scene.skeleton, frame, options, sizes, drawing);
    add_marks(scene.marks, thickness, drawing);
    if (!scene.failure.empty()) add_failure_frame(options, sizes, drawing);
    return drawing;
}

} // namespace skelgen::render
