#include "shading.hpp"

#include <algorithm>
#include <cmath>

namespace skelgen::render {
namespace {

using Rgb = Eigen::Array3f;

Layer layer(const Rgb& colour, float opacity) {
    Layer result;
    result << colour.min(1.0f).max(0.0f) * opacity, opacity;
    return result;
}

float smooth(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

/// A large soft light from the upper left, wrapped around the body so that no side goes black; 0 to 1.
float soft_light(const Eigen::Vector3f& normal) {
    const Eigen::Vector3f key(-0.42f, 0.62f, 0.66f);
    const float wrapped = (normal.dot(key) + 0.55f) / 1.55f;
    return std::clamp(wrapped, 0.0f, 1.0f);
}

float glint(const Eigen::Vector3f& normal) {
    const Eigen::Vector3f half_way(-0.2305f, 0.3403f, 0.9116f); // between the light and the viewer
    const float c = std::max(0.0f, normal.dot(half_way));
    const float c4 = c * c * c * c;
    const float c16 = c4 * c4 * c4 * c4;
    return c16 * c16;
}

/// 0 where the surface faces the viewer, 1 at the silhouette.
float grazing(const Eigen::Vector3f& normal) {
    const float away = 1.0f - std::clamp(normal.z(), 0.0f, 1.0f);
    return away * away;
}

} // namespace

Layer shade_skin(const Eigen::Vector3f& normal, float ambient) {
    const Rgb shadow(0.40f, 0.46f, 0.56f);
    const Rgb lit(0.93f, 0.94f, 0.96f);
    const Rgb edge(0.25f, 0.32f, 0.44f);
    const float light = soft_light(normal) * (0.45f + 0.55f * ambient);
    const float rim = grazing(normal);
    const Rgb body = shadow + (lit - shadow) * light + 0.10f * glint(normal);
    return layer(body + (edge - body) * (0.65f * rim), 0.40f + 0.50f * rim);
}

Layer shade_painted_skin(const Eigen::Vector3f& normal, float ambient, const Eigen::Array3f& colour) {
    const float light = (0.50f + 0.62f * soft_light(normal)) * (0.55f + 0.45f * ambient);
    return layer(colour * light * (1.0f - 0.35f * grazing(normal)) + 0.06f * glint(normal), 1.0f);
}

Layer shade_far_skin(const Eigen::Vector3f& normal, float ambient) {
    const Rgb shadow(0.52f, 0.58f, 0.67f);
    const Rgb lit(0.90f, 0.92f, 0.95f);
    const float light = soft_light(normal) * (0.45f + 0.55f * ambient);
    return layer(shadow + (lit - shadow) * light, 0.75f);
}

Layer shade_solid(const Eigen::Vector3f& normal, const Colour& colour) {
    const Rgb base(colour.red, colour.green, colour.blue);
    const float light = 0.72f + 0.40f * soft_light(normal);
    const float rim = smooth(0.62f, 0.30f, normal.z());
    return layer((base * light + 0.22f * glint(normal)) * (1.0f - 0.45f * rim), 1.0f);
}

} // namespace skelgen::render
