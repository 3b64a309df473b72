#include "pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "body_surface.hpp"

namespace skelgen::synth {
namespace {

using Mesh = TriangleMesh<double>;

constexpr std::array<PartName, part_count> all_parts{
    PartName::trunk,         PartName::head,       PartName::left_upper_arm,
    PartName::left_forearm,  PartName::left_hand,  PartName::right_upper_arm,
    PartName::right_forearm, PartName::right_hand, PartName::left_thigh,
    PartName::left_calf,     PartName::left_foot,  PartName::right_thigh,
    PartName::right_calf,    PartName::right_foot};

Mesh joined(const Mesh& a, const Mesh& b) {
    Mesh mesh;
    mesh.vertices.resize(a.vertices.rows() + b.vertices.rows(), 3);
    mesh.vertices << a.vertices, b.vertices;
    mesh.faces.resize(a.faces.rows() + b.faces.rows(), 3);
    mesh.faces << a.faces, (b.faces.array() + static_cast<int>(a.vertices.rows())).matrix();
    return mesh;
}

/// The faces that `keep` accepts, by their corners' positions, and the vertices that they use.
template <typename Keep>
Mesh faces_where(const Mesh& mesh, const Keep& keep) {
    std::vector<int> renamed(static_cast<std::size_t>(mesh.vertices.rows()), -1);
    std::vector<int> kept;
    std::vector<std::array<int, 3>> faces;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        if (!keep(mesh.vertices.row(mesh.faces(f, 0)), mesh.vertices.row(mesh.faces(f, 1)),
                  mesh.vertices.row(mesh.faces(f, 2))))
            continue;
        std::array<int, 3>& face = faces.emplace_back();
        for (int k = 0; k < 3; ++k) {
            int& name = renamed[static_cast<std::size_t>(mesh.faces(f, k))];
            if (name < 0) {
                name = static_cast<int>(kept.size());
                kept.push_back(mesh.faces(f, k));
            }
            face[static_cast<std::size_t>(k)] = name;
        }
    }
    Mesh out;
    out.vertices.resize(static_cast<Eigen::Index>(kept.size()), 3);
    out.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t v = 0; v < kept.size(); ++v)
        out.vertices.row(static_cast<Eigen::Index>(v)) = mesh.vertices.row(kept[v]);
    for (std::size_t f = 0; f < faces.size(); ++f)
        out.faces.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    return out;
}

// ------------------------------------------------------------------------------------------------------------- limbs

/// Of all triangles, roughly in proportion to a part's surface and its grain.
double share(PartName name) {
    if (name == PartName::trunk) return 0.26;
    if (name == PartName::head) return 0.14;
    const int step = (static_cast<int>(name) - static_cast<int>(PartName::left_upper_arm)) % 3;
    if (name < PartName::left_thigh) return std::array{0.035, 0.035, 0.08}[static_cast<std::size_t>(step)];
    return std::array{0.06, 0.045, 0.045}[static_cast<std::size_t>(step)];
}

Mesh mesh_part(const ImplicitBody& body, PartName name, double scale, int faces) {
    const Ball around = body.part_bound(name);
    const ImplicitSurface surface{[&](const Vec3& p) { return body.part_alone(name, p); },
                                  [&](const Vec3& p) { return body.grain(p); }, body.part_middle(name),
                                  around.radius + 0.02 * scale};
    return mesh_surface(surface, static_cast<int>(share(name) * faces), true);
}

/// How deep inside another part: negative there.
double other_parts(const ImplicitBody& body, PartName name, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const PartName other : all_parts)
        if (other != name) least = std::min(least, body.part_alone(other, p));
    return least;
}

Mesh separate_limbs(const ImplicitBody& body, double scale, bool is_open, int faces) {
    const double deep = -0.01 * scale;
    Mesh out;
    out.vertices.resize(0, 3), out.faces.resize(0, 3);
    for (const PartName name : all_parts) {
        const Mesh part = mesh_part(body, name, scale, faces);
        const auto is_seen = [&](const auto&... corners) {
            return ((other_parts(body, name, corners.transpose()) > deep) || ...);
        };
        out = joined(out, is_open ? faces_where(part, is_seen) : part);
    }
    return out;
}

Mesh whole(const ImplicitBody& body, const Proportions& proportions, int faces) {
    return mesh_surface(surface_of(body, proportions), faces, true);
}

/// The clothes alone: what of the dressed body's surface is off the naked one's.
Mesh shells(const ImplicitBody& naked, const ImplicitBody& dressed, const Proportions& proportions, int faces) {
    const double off = 0.003 * proportions.scale;
    return faces_where(whole(dressed, proportions, faces),
                       [&](const auto&... corners) { return ((naked(corners.transpose()) > off) && ...); });
}

// ------------------------------------------------------------------------------------------------------------- seams

/// Which limb a point belongs to, and whether it is on the front or the back of it.
int chart(const ImplicitBody& body, const Vec3& p) {
    PartName nearest = PartName::trunk;
    for (const PartName name : all_parts)
        if (body.part_alone(name, p) < body.part_alone(nearest, p)) nearest = name;
    return 2 * static_cast<int>(nearest) + (body.in_part(nearest, p).y() > 0 ? 1 : 0);
}

/// The same triangles; vertices on the border of charts are as many as charts meet there.
Mesh split_at_seams(const ImplicitBody& body, const Mesh& mesh) {
    std::map<std::pair<int, int>, int> own; // chart and vertex
    std::vector<int> source;
    Mesh out;
    out.faces.resize(mesh.faces.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Vec3 centre = (mesh.vertices.row(mesh.faces(f, 0)) + mesh.vertices.row(mesh.faces(f, 1)) +
                             mesh.vertices.row(mesh.faces(f, 2)))
                                .transpose() /
                            3;
        const int in = chart(body, centre);
        for (int k = 0; k < 3; ++k) {
            const auto [place, is_new] = own.try_emplace({in, mesh.faces(f, k)}, static_cast<int>(source.size()));
            if (is_new) source.push_back(mesh.faces(f, k));
            out.faces(f, k) = place->second;
        }
    }
    out.vertices.resize(static_cast<Eigen::Index>(source.size()), 3);
    for (std::size_t v = 0; v < source.size(); ++v)
        out.vertices.row(static_cast<Eigen::Index>(v)) = mesh.vertices.row(source[v]);
    return out;
}

// -------------------------------------------------------------------------------------------------------------- face

/// An ellipsoid around the origin, of rings of eight vertices between two poles.
Mesh ellipsoid(const Vec3& radii) {
    constexpr int around = 8, rings = 5;
    Mesh mesh;
    mesh.vertices.resize(around * rings + 2, 3);
    mesh.faces.resize(2 * around * rings, 3);
    for (int ring = 0; ring < rings; ++ring)
        for (int k = 0; k < around; ++k) {
            const double tilt = std::numbers::pi * (ring + 1) / (rings + 1), turn = 2 * std::numbers::pi * k / around;
            mesh.vertices.row(ring * around + k) =
                Vec3(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), -std::cos(tilt))
                    .cwiseProduct(radii);
        }
    const int bottom = around * rings, top = bottom + 1, last = around * (rings - 1);
    mesh.vertices.row(bottom) << 0, 0, -radii.z();
    mesh.vertices.row(top) << 0, 0, radii.z();
    Eigen::Index f = 0;
    for (int k = 0; k < around; ++k) {
        const int next = (k + 1) % around;
        mesh.faces.row(f++) << bottom, next, k;
        mesh.faces.row(f++) << top, last + k, last + next;
        for (int ring = 0; ring + 1 < rings; ++ring) {
            const int low = ring * around, high = low + around;
            mesh.faces.row(f++) << low + k, low + next, high + next;
            mesh.faces.row(f++) << low + k, high + next, high + k;
        }
    }
    return mesh;
}

/// `mesh` in the frame of the head, with its origin this far (in units of the head's size) before the skull's middle;
/// of `place`, the depth is from the face's surface, inwards.
Mesh in_head(const ImplicitBody& body, double head_scale, Mesh mesh, const Vec3& place) {
    const Eigen::Isometry3d& frame = body.part(PartName::head).frame;
    double inside = 0, outside = 0.2 * head_scale;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (inside + outside);
        const Vec3 p = frame * Vec3(place.x() * head_scale, -middle, place.z() * head_scale);
        (body.part_alone(PartName::head, p) < 0 ? inside : outside) = middle;
    }
    const Vec3 centre(place.x() * head_scale, -inside + place.y() * head_scale, place.z() * head_scale);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        mesh.vertices.row(v) = (frame * Vec3(mesh.vertices.row(v).transpose() + centre)).transpose();
    return mesh;
}

/// Eyeballs of 24 mm that look out of the face, 64 mm apart; teeth as two bars of 46 mm behind the lips.
Mesh eyes_and_teeth(const ImplicitBody& body, double h) {
    const Mesh eye = ellipsoid(h * Vec3(0.012, 0.012, 0.012)), row = ellipsoid(h * Vec3(0.023, 0.014, 0.005));
    const Mesh eyes =
        joined(in_head(body, h, eye, {0.032, 0.006, 0.035}), in_head(body, h, eye, {-0.032, 0.006, 0.035}));
    const Mesh teeth = joined(in_head(body, h, row, {0, 0.024, -0.032}), in_head(body, h, row, {0, 0.024, -0.043}));
    return joined(eyes, teeth);
}

} // namespace

Mesh put_together(const ImplicitBody& naked, const ImplicitBody& dressed, const Proportions& proportions,
                  const BodyPieces& pieces, int faces) {
    const ImplicitBody& body = pieces.clothes ? naked : dressed;
    Mesh mesh = pieces.limbs == LimbPieces::whole
                    ? whole(body, proportions, faces)
                    : separate_limbs(body, proportions.scale, pieces.limbs == LimbPieces::open, faces);
    if (pieces.clothes) mesh = joined(mesh, shells(naked, dressed, proportions, faces));
    if (pieces.seams) mesh = split_at_seams(body, mesh);
    if (pieces.face) mesh = joined(mesh, eyes_and_teeth(body, proportions.head_scale));
    return mesh;
}

} // namespace skelgen::synth
