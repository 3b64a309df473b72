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

Mesh mesh_part(const ImplicitBody& body, PartName name, double scale, int faces, bool one_body) {
    const Ball around = body.part_bound(name);
    const ImplicitSurface surface{[&](const Vec3& p) { return body.part_alone(name, p); },
                                  [&](const Vec3& p) { return body.grain(p); }, body.part_middle(name),
                                  around.radius + 0.02 * scale};
    return mesh_surface(surface, static_cast<int>(share(name) * faces), one_body);
}

/// How deep inside another part: negative there.
double other_parts(const ImplicitBody& body, PartName name, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const PartName other : all_parts)
        if (other != name) least = std::min(least, body.part_alone(other, p));
    return least;
}

Mesh separate_limbs(const ImplicitBody& body, double scale, bool is_open, int faces, bool one_body) {
    const double deep = -0.01 * scale;
    Mesh out;
    out.vertices.resize(0, 3), out.faces.resize(0, 3);
    for (const PartName name : all_parts) {
        const Mesh part = mesh_part(body, name, scale, faces, one_body);
        const auto is_seen = [&](const auto&... corners) {
            return ((other_parts(body, name, corners.transpose()) > deep) || ...);
        };
        out = joined(out, is_open ? faces_where(part, is_seen) : part);
    }
    return out;
}

Mesh whole(const ImplicitBody& body, const Proportions& proportions, int faces, bool one_body) {
    return mesh_surface(surface_of(body, proportions), faces, one_body);
}

/// The clothes alone: what of the dressed body's surface is off the naked one's.
Mesh shells(const ImplicitBody& naked, const ImplicitBody& dressed, const Proportions& proportions, int faces,
            bool one_body) {
    const double off = 0.003 * proportions.scale;
    return faces_where(whole(dressed, proportions, faces, one_body),
                       [&](const auto&... corners) { return ((naked(corners.transpose()) > off) && ...); });
}

// ------------------------------------------------------------------------------------------------------------- robot

/// The surface of the cube from -1 to 1, outwards; each side is a grid of `cells` by `cells` squares.
Mesh cube(int cells) {
    std::map<std::array<int, 3>, int> known;
    std::vector<std::array<int, 3>> corners, faces;
    const auto corner = [&](int axis, int end, int u, int v) {
        std::array<int, 3> at{};
        at[static_cast<std::size_t>(axis)] = end;
        at[static_cast<std::size_t>((axis + 1) % 3)] = u, at[static_cast<std::size_t>((axis + 2) % 3)] = v;
        const auto [place, is_new] = known.try_emplace(at, static_cast<int>(corners.size()));
        if (is_new) corners.push_back(at);
        return place->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const int end : {0, cells})
            for (int u = 0; u < cells; ++u)
                for (int v = 0; v < cells; ++v) {
                    const int a = corner(axis, end, u, v), b = corner(axis, end, u + 1, v);
                    const int c = corner(axis, end, u + 1, v + 1), d = corner(axis, end, u, v + 1);
                    faces.push_back(end > 0 ? std::array{a, b, c} : std::array{a, c, b});
                    faces.push_back(end > 0 ? std::array{a, c, d} : std::array{a, d, c});
                }
    Mesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(corners.size()), 3);
    mesh.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t v = 0; v < corners.size(); ++v)
        for (std::size_t axis = 0; axis < 3; ++axis)
            mesh.vertices(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(axis)) =
                2.0 * corners[v][axis] / cells - 1;
    for (std::size_t f = 0; f < faces.size(); ++f)
        mesh.faces.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    return mesh;
}

/// Boxes around the bones, balls for head and hands.
class Robot {
public:
    Robot(const ImplicitBody& body, const Proportions& p, double gap, int faces)
        : body_(body), p_(p), gap_(gap),
          cube_(cube(std::max(2, static_cast<int>(std::sqrt(faces / (12.0 * pieces)))))) {
        mesh_.vertices.resize(0, 3), mesh_.faces.resize(0, 3);
        add_trunk();
        const double h = p.head_scale;
        add_ball(PartName::head, {0, -0.01 * h, 0.060 * h}, h * Vec3(0.090, 0.105, 0.105));
        for (const PartName limb :
             {PartName::left_upper_arm, PartName::right_upper_arm, PartName::left_thigh, PartName::right_thigh}) {
            add_limb(limb), add_limb(next(limb, 1));
            if (limb < PartName::left_thigh)
                add_hand(limb);
            else
                add_foot(limb);
        }
    }

    [[nodiscard]] const Mesh& mesh() const { return mesh_; }

private:
    static constexpr int pieces = 15;

    /// `place` maps the cube's points to coordinates of the part.
    template <typename Place>
    void add(PartName name, const Place& place) {
        Mesh piece = cube_;
        for (Eigen::Index v = 0; v < piece.vertices.rows(); ++v) {
            const Vec3 p = place(Vec3(piece.vertices.row(v).transpose()));
            piece.vertices.row(v) = name == PartName::trunk ? body_.trunk_to_world(p) : body_.part(name).to_world(p);
        }
        const Part& part = body_.part(name);
        if (name != PartName::trunk && part.limb != (part.side < 0)) // mirrored: turned inside out
            piece.faces.col(1).swap(piece.faces.col(2));
        mesh_ = joined(mesh_, piece);
    }

    void add_box(PartName name, const Vec3& low, const Vec3& high) {
        add(name, [&](const Vec3& p) -> Vec3 { return (low + high) / 2 + p.cwiseProduct(high - low) / 2; });
    }

    void add_ball(PartName name, const Vec3& centre, const Vec3& radii) {
        add(name, [&](const Vec3& p) -> Vec3 { return centre + p.normalized().cwiseProduct(radii); });
    }

    /// Half the thickness of a limb, as far as there is room for it beside the other one.
    [[nodiscard]] double radius(PartName name) const {
        const Part& part = body_.part(name);
        const Ring ring = outline(part.blobs).ring(part.length / 2);
        const double mean = (ring.side + ring.front) / 2;
        return name < PartName::left_thigh ? mean : std::min(mean, 0.85 * p_.hip_half_width);
    }

    /// Half of the gap at a joint, a quarter of the limb at most.
    [[nodiscard]] double half_gap(PartName limb) const {
        return std::min(gap_ * radius(limb), 0.25 * body_.part(limb).length);
    }

    /// Pelvis and chest.
    void add_trunk() {
        const PosedSkeleton& s = body_.skeleton();
        const double waist = s.rest_position(BodyJoint::waist).z(), neck = s.rest_position(BodyJoint::neck).z();
        const double hip = s.rest_position(BodyJoint::left_hip).z(), k = p_.scale;
        const double arm = radius(PartName::left_upper_arm), thigh = radius(PartName::left_thigh);
        const double slit = std::min(gap_ * arm, 0.25 * (waist - hip)), wide = p_.hip_half_width + thigh;
        const double chest = p_.shoulder_half_width - arm - slit;
        const double lowest = std::min(hip + 0.6 * thigh, (hip + waist) / 2);
        add_box(PartName::trunk, {-wide, -0.10 * k, lowest}, {wide, 0.10 * k, waist - slit});
        add_box(PartName::trunk, {-chest, -0.11 * k, waist + slit}, {chest, 0.11 * k, neck - slit / 2});
    }

    void add_limb(PartName name) {
        const double free = half_gap(name), r = radius(name);
        add_box(name, {-r, -r, free}, {r, r, body_.part(name).length - free});
    }

    void add_hand(PartName upper_arm) {
        const double free = half_gap(next(upper_arm, 1)), h = p_.hand_scale, end = 0.18 * h;
        add_ball(next(upper_arm, 2), {0, 0, (free + end) / 2}, {0.045 * h, 0.06 * h, (end - free) / 2});
    }

    void add_foot(PartName thigh) {
        const double f = p_.foot_scale, sole = -p_.ankle_height;
        const double top = std::max(-half_gap(next(thigh, 1)), sole / 2);
        add_box(next(thigh, 2), {-0.045 * f, -0.17 * f, sole}, {0.045 * f, 0.05 * f, top});
    }

    const ImplicitBody& body_;
    const Proportions& p_;
    double gap_;
    Mesh cube_;
    Mesh mesh_;
};

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
                  const BodyPieces& pieces, int faces, bool one_body) {
    if (pieces.limbs == LimbPieces::apart) return Robot(naked, proportions, pieces.gap, faces).mesh();
    const ImplicitBody& body = pieces.clothes ? naked : dressed;
    Mesh mesh = pieces.limbs == LimbPieces::whole
                    ? whole(body, proportions, faces, one_body)
                    : separate_limbs(body, proportions.scale, pieces.limbs == LimbPieces::open, faces, one_body);
    if (pieces.clothes) mesh = joined(mesh, shells(naked, dressed, proportions, faces, one_body));
    if (pieces.seams) mesh = split_at_seams(body, mesh);
    if (pieces.face) mesh = joined(mesh, eyes_and_teeth(body, proportions.head_scale));
    return mesh;
}

} // namespace skelgen::synth
