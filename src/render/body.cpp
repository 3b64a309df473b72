#include "body.hpp"

#include <cmath>
#include <limits>

#include "rasterize.hpp"
#include "shading.hpp"
#include "surface_light.hpp"

namespace skelgen::render {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The mesh in samples, y down, with the normals in picture axes (y up).
struct Surface {
    Points<double> positions;
    Points<double> normals;
    std::vector<double> ambient;
    std::vector<Eigen::Array3f> colours; ///< 0 to 1; empty: translucent skin
};

Surface project_surface(const Scene& scene, const Projection& projection, int supersampling) {
    const TriangleMesh<double>& mesh = scene.mesh;
    Surface surface;
    for (const auto& [red, green, blue] : scene.colours)
        surface.colours.push_back(Eigen::Array3f(red, green, blue) / 255.0f);
    const Points<double> normals = outward_normals(mesh);
    surface.ambient = ambient_light(mesh, normals);
    surface.positions =
        (mesh.vertices * projection.turn.transpose() * projection.scale).rowwise() + projection.shift.transpose();
    surface.positions *= supersampling;
    surface.normals = normals * projection.turn.transpose();
    surface.normals.col(1) *= -1;
    return surface;
}

RoundCone in_samples(RoundCone cone, int supersampling) {
    cone.start *= supersampling;
    cone.end *= supersampling;
    cone.start_radius *= supersampling;
    cone.end_radius *= supersampling;
    return cone;
}

/// What is seen of the skin at a sample; depth is minus or plus infinity where there is none.
struct SkinSample {
    float depth;
    float ambient;
    Eigen::Vector3f normal;
    Eigen::Array3f colour; ///< below 0: translucent
};

/// The colour of skin that has none.
Eigen::Array3f translucent() { return Eigen::Array3f::Constant(-1); }

struct SolidSample {
    float depth;
    Layer layer;
};

/// The samples of a few rows of pixels: the picture is drawn in bands so that memory does not grow with its height.
struct Band {
    SampleRect rect;
    std::vector<SkinSample> nearest;
    std::vector<SkinSample> farthest;
    std::vector<SolidSample> solid;

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - rect.top) * static_cast<std::size_t>(rect.width) +
               static_cast<std::size_t>(x);
    }
};

void clear(Band& band) {
    const auto count =
        static_cast<std::size_t>(band.rect.bottom - band.rect.top) * static_cast<std::size_t>(band.rect.width);
    band.nearest.assign(count, {-infinity, 1, Eigen::Vector3f::UnitZ(), translucent()});
    band.farthest.assign(count, {infinity, 1, Eigen::Vector3f::UnitZ(), translucent()});
    band.solid.assign(count, {-infinity, Layer::Zero()});
}

void draw_face(const Surface& surface, const Eigen::RowVector3i& face, Band& band) {
    const auto corner = [&](int i) { return surface.positions.row(face[i]); };
    const auto flat = [&](int i) -> Eigen::Vector2d { return corner(i).head<2>().transpose(); };
    const Eigen::Array3d z(corner(0).z(), corner(1).z(), corner(2).z());
    Eigen::Matrix3d normals; // columns: corners
    normals << surface.normals.row(face[0]).transpose(), surface.normals.row(face[1]).transpose(),
        surface.normals.row(face[2]).transpose();
    const auto ambient_at = [&](int i) { return surface.ambient[static_cast<std::size_t>(face[i])]; };
    const Eigen::Array3d ambient(ambient_at(0), ambient_at(1), ambient_at(2));
    rasterize_triangle(flat(0), flat(1), flat(2), band.rect, [&](int x, int y, const Eigen::Array3d& weights) {
        const std::size_t at = band.index(x, y);
        const auto depth = static_cast<float>((weights * z).sum());
        const bool near = depth > band.nearest[at].depth;
        const bool far = depth < band.farthest[at].depth;
        if (!near && !far) return;
        const Eigen::Vector3f normal = (normals * weights.matrix()).cast<float>();
        Eigen::Array3f colour = translucent();
        if (!surface.colours.empty()) {
            colour.setZero();
            for (int i = 0; i < 3; ++i)
                colour += static_cast<float>(weights[i]) * surface.colours[static_cast<std::size_t>(face[i])];
        }
        const SkinSample sample{depth, static_cast<float>((weights * ambient).sum()), normal, colour};
        if (near) band.nearest[at] = sample;
        if (far) band.farthest[at] = sample;
    });
}

/// Draws the discs that sweep from the cone's start to its end: exact for balls and for cones across the line of sight.
void draw_cone(const RoundCone& cone, Band& band) {
    const double reach = std::max(cone.start_radius, cone.end_radius);
    const auto [low_x, high_x] = std::minmax(cone.start.x(), cone.end.x());
    const auto [low_y, high_y] = std::minmax(cone.start.y(), cone.end.y());
    const int from_x = static_cast<int>(std::clamp(low_x - reach, 0.0, double(band.rect.width)));
    const int to_x = static_cast<int>(std::clamp(high_x + reach + 1, 0.0, double(band.rect.width)));
    const int from_y = static_cast<int>(std::clamp(low_y - reach, double(band.rect.top), double(band.rect.bottom)));
    const int to_y = static_cast<int>(std::clamp(high_y + reach + 1, double(band.rect.top), double(band.rect.bottom)));
    const Eigen::Vector2d start = cone.start.head<2>();
    const Eigen::Vector2d along = cone.end.head<2>() - start;
    const double length2 = along.squaredNorm();
    for (int y = from_y; y < to_y; ++y)
        for (int x = from_x; x < to_x; ++x) {
            const Eigen::Vector2d point(x + 0.5, y + 0.5);
            const double t = length2 > 0 ? std::clamp((point - start).dot(along) / length2, 0.0, 1.0) : 0.0;
            const double radius = cone.start_radius + t * (cone.end_radius - cone.start_radius);
            const Eigen::Vector2d offset = (point - start - t * along) / radius;
            if (offset.squaredNorm() > 1) continue;
            const double bulge = std::sqrt(1 - offset.squaredNorm());
            const auto depth =
                static_cast<float>(cone.start.z() + t * (cone.end.z() - cone.start.z()) + radius * bulge);
            SolidSample& sample = band.solid[band.index(x, y)];
            if (depth <= sample.depth) continue;
            const Eigen::Vector3f normal(static_cast<float>(offset.x()), static_cast<float>(-offset.y()),
                                         static_cast<float>(bulge));
            sample = {depth, shade_solid(normal, cone.colour)};
        }
}

/// A unit normal on the viewer's side; interpolation leaves it shorter, an open mesh shows its back.
Eigen::Vector3f toward_viewer(Eigen::Vector3f normal, bool flip) {
    if (flip) normal = -normal;
    const float length = normal.norm();
    return length > 0 ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ();
}

/// Far skin, skeleton and near skin in the order of their depths.
Layer composite(const SkinSample& nearest, const SkinSample& farthest, const SolidSample& solid) {
    const bool has_skin = nearest.depth > -infinity;
    const bool has_solid = solid.depth > -infinity;
    if (!has_skin) return solid.layer;
    if (nearest.colour[0] >= 0) {
        const Layer painted = shade_painted_skin(toward_viewer(nearest.normal, nearest.normal.z() < -0.3f),
                                                 nearest.ambient, nearest.colour);
        if (!has_solid) return painted;
        return solid.depth > nearest.depth ? solid.layer : over(painted * 0.55f, solid.layer);
    }
    Layer far = shade_far_skin(toward_viewer(farthest.normal, farthest.normal.z() < 0), farthest.ambient);
    Layer near = shade_skin(toward_viewer(nearest.normal, nearest.normal.z() < -0.3f), nearest.ambient);
    if (!has_solid) return over(near, far);
    if (solid.depth > nearest.depth) return solid.layer;
    near *= 0.55f; // a thinner veil over the skeleton keeps its colours
    if (solid.depth > farthest.depth) return over(near, solid.layer);
    far *= 0.55f;
    return over(near, over(far, solid.layer));
}

Pixel to_pixel(Layer sum, Background background) {
    if (background == Background::white) sum = over(sum, Layer::Ones());
    const float opacity = sum[3];
    if (opacity <= 0) return {0, 0, 0, 0};
    return {to_byte(sum[0] / opacity), to_byte(sum[1] / opacity), to_byte(sum[2] / opacity), to_byte(opacity)};
}

Layer average(const Band& band, int x, int y, int supersampling) {
    Layer sum = Layer::Zero();
    for (int dy = 0; dy < supersampling; ++dy)
        for (int dx = 0; dx < supersampling; ++dx) {
            const std::size_t at = band.index(x * supersampling + dx, y * supersampling + dy);
            sum += composite(band.nearest[at], band.farthest[at], band.solid[at]);
        }
    return sum / static_cast<float>(supersampling * supersampling);
}

/// For each band, the faces that reach into it.
std::vector<std::vector<Eigen::Index>> sort_into_bands(const Surface& surface, const Triangles& faces, int band_rows,
                                                       int bands) {
    std::vector<std::vector<Eigen::Index>> sorted(static_cast<std::size_t>(bands));
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const auto y = [&](int i) { return surface.positions(faces(f, i), 1); };
        const auto [low, high] = std::minmax({y(0), y(1), y(2)});
        const auto band_of = [&](double row) {
            return static_cast<std::size_t>(std::clamp(std::floor(row / band_rows), 0.0, double(bands - 1)));
        };
        for (std::size_t band = band_of(low); band <= band_of(high); ++band) sorted[band].push_back(f);
    }
    return sorted;
}

} // namespace

Image draw_body(const Scene& scene, const Projection& projection, const std::vector<RoundCone>& cones,
                const RenderOptions& options) {
    const TriangleMesh<double>& mesh = scene.mesh;
    constexpr int pixel_rows = 16;
    const int samples = options.supersampling;
    const Surface surface = project_surface(scene, projection, samples);
    const int bands = (options.height + pixel_rows - 1) / pixel_rows;
    const auto faces_of_band = sort_into_bands(surface, mesh.faces, pixel_rows * samples, bands);

    Image image(options.width, options.height, {0, 0, 0, 0});
    Band band;
    for (int b = 0; b < bands; ++b) {
        const int top = b * pixel_rows;
        const int bottom = std::min(top + pixel_rows, options.height);
        band.rect = {options.width * samples, top * samples, bottom * samples};
        clear(band);
        for (const Eigen::Index f : faces_of_band[static_cast<std::size_t>(b)])
            draw_face(surface, mesh.faces.row(f), band);
        for (const RoundCone& cone : cones) draw_cone(in_samples(cone, samples), band);
        for (int y = top; y < bottom; ++y)
            for (int x = 0; x < options.width; ++x)
                image.at(x, y) = to_pixel(average(band, x, y, samples), options.background);
    }
    return image;
}

} // namespace skelgen::render
