#include "limbs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::damage {
namespace {

enum class Across { next_bone, both_bones, last_bone }; ///< which way a cut's plane faces

/// Where a limb is cut off: somewhere along the bone from `joint` to `next`.
struct Cut {
    std::size_t limb; ///< the one that begins here
    std::string last, joint, next;
    Across across;              ///< tried first, and taken of like ways
    std::vector<double> places; ///< parts of the bone, tried in turn
};

std::vector<Cut> cuts() {
    const std::vector<double> ball{0.2, 0.3, 0.4, 0.5}, hinge{0, 0.1, -0.1, 0.2, -0.2, 0.3};
    std::vector<Cut> all{{1, "chest", "neck", "head", Across::next_bone, {0.3, 0.4, 0.2, 0.5, 0.6, 0.1, 0}}};
    std::size_t limb = 2;
    for (const std::string side : {"left_", "right_"}) {
        all.push_back({limb++, "chest", side + "shoulder", side + "elbow", Across::next_bone, ball});
        all.push_back({limb++, side + "shoulder", side + "elbow", side + "wrist", Across::both_bones, hinge});
        all.push_back({limb++, side + "elbow", side + "wrist", side + "hand", Across::last_bone, hinge});
    }
    for (const std::string side : {"left_", "right_"}) {
        all.push_back({limb++, "crotch", side + "hip", side + "knee", Across::next_bone, ball});
        all.push_back({limb++, side + "hip", side + "knee", side + "ankle", Across::both_bones, hinge});
        all.push_back({limb++, side + "knee", side + "ankle", side + "foot", Across::last_bone, hinge});
    }
    return all;
}

struct Plane {
    Vec3 point, normal;
    [[nodiscard]] double side(const Vec3& p) const { return normal.dot(p - point); }
};

Plane plane_of(const Cut& cut, Across across, double place, const KinematicSkeleton<double>& skeleton) {
    const Vec3 joint = joint_position(skeleton, cut.joint), next = joint_position(skeleton, cut.next);
    const Vec3 to_next = (next - joint).normalized();
    const Vec3 from_last = (joint - joint_position(skeleton, cut.last)).normalized();
    const Vec3 both = to_next + from_last;
    Vec3 normal = to_next;
    if (across == Across::last_bone) normal = from_last;
    if (across == Across::both_bones && both.norm() > 0.2) normal = both.normalized();
    return {joint + place * (next - joint), normal};
}

/// Groups of faces that `is_in` accepts, each connected across edges.
template <typename IsIn>
std::vector<std::vector<std::size_t>> connected_groups(const std::vector<Face>& beyond, const IsIn& is_in) {
    std::vector<bool> seen(beyond.size(), false);
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t first = 0; first < beyond.size(); ++first) {
        if (seen[first] || !is_in(first)) continue;
        std::vector<std::size_t> group{first};
        seen[first] = true;
        for (std::size_t i = 0; i < group.size(); ++i)
            for (const int next : beyond[group[i]]) {
                const auto n = static_cast<std::size_t>(next);
                if (next < 0 || seen[n] || !is_in(n)) continue;
                seen[n] = true;
                group.push_back(n);
            }
        groups.push_back(std::move(group));
    }
    return groups;
}

/// The ring of faces across the plane whose middle is nearest to the plane's point.
std::vector<std::size_t> nearest_ring(const Soup& soup, const std::vector<Face>& beyond, const Plane& plane) {
    const auto crosses = [&](std::size_t f) {
        const Face& face = soup.faces[f];
        const bool first = plane.side(soup.at(face[0])) > 0;
        return (plane.side(soup.at(face[1])) > 0) != first || (plane.side(soup.at(face[2])) > 0) != first;
    };
    std::vector<std::size_t> nearest;
    double least = 0;
    for (auto& ring : connected_groups(beyond, crosses)) {
        Vec3 low = centroid(soup, soup.faces[ring.front()]), high = low;
        for (const std::size_t f : ring) {
            low = low.cwiseMin(centroid(soup, soup.faces[f]));
            high = high.cwiseMax(centroid(soup, soup.faces[f]));
        }
        const double distance = (0.5 * (low + high) - plane.point).norm();
        if (!nearest.empty() && distance >= least) continue;
        least = distance;
        nearest = std::move(ring);
    }
    return nearest;
}

/// What is to be cut off.
struct CutFaces {
    std::vector<bool> off; ///< per face
    double rim = 0;        ///< length of the cut, roughly
};

double rim_of(const Soup& soup, const std::vector<std::size_t>& ring) {
    double rim = 0;
    for (const std::size_t f : ring) {
        const Face& face = soup.faces[f];
        const Vec3 a = soup.at(face[0]);
        rim += std::sqrt((soup.at(face[1]) - a).cross(soup.at(face[2]) - a).norm());
    }
    return rim;
}

/// The faces beyond the plane, if its nearest ring parts the surface there.
std::optional<CutFaces> faces_beyond(const Soup& soup, const std::vector<Face>& beyond, const Plane& plane) {
    const std::vector<std::size_t> ring = nearest_ring(soup, beyond, plane);
    if (ring.empty()) return std::nullopt;
    std::vector<bool> in_ring(beyond.size(), false);
    for (const std::size_t f : ring) in_ring[f] = true;
    std::set<std::size_t> above, below; // the ring's neighbours on either side
    for (const std::size_t f : ring)
        for (const int next : beyond[f]) {
            if (next < 0 || in_ring[static_cast<std::size_t>(next)]) continue;
            const auto n = static_cast<std::size_t>(next);
            (plane.side(centroid(soup, soup.faces[n])) > 0 ? above : below).insert(n);
        }
    if (above.empty() || below.empty()) return std::nullopt;
    CutFaces out{std::vector<bool>(beyond.size(), false), rim_of(soup, ring)};
    for (const auto& group : connected_groups(beyond, [&](std::size_t f) { return !in_ring[f]; })) {
        const auto touches = [&](const std::set<std::size_t>& side) {
            return std::any_of(group.begin(), group.end(), [&](std::size_t f) { return side.count(f) > 0; });
        };
        const bool is_above = touches(above);
        if (is_above && touches(below)) return std::nullopt;
        if (!is_above) continue;
        for (const std::size_t f : group) out.off[f] = true;
    }
    for (const std::size_t f : ring) out.off[f] = plane.side(centroid(soup, soup.faces[f])) > 0;
    return out;
}

/// Which limb ends at a face, by the name of its end on the surface.
using EndFaces = std::map<std::size_t, std::string>;

EndFaces faces_at_ends(const Soup& soup, const KinematicSkeleton<double>& skeleton) {
    EndFaces ends;
    for (const auto& [end, place] : skeleton.end_points) {
        std::size_t nearest = 0;
        for (std::size_t f = 1; f < soup.faces.size(); ++f)
            if ((centroid(soup, soup.faces[f]) - place).norm() < (centroid(soup, soup.faces[nearest]) - place).norm())
                nearest = f;
        ends[nearest] = end;
    }
    return ends;
}

/// Does the limb to be cut off end beyond the cut, and no other?
bool takes_off(const std::vector<bool>& off, const Cut& cut, const EndFaces& ends) {
    return std::all_of(ends.begin(), ends.end(), [&](const auto& face_and_end) {
        const auto& [face, end] = face_and_end;
        const SidedName limb = split_side(end), joint = split_side(cut.next);
        const bool is_arm = joint.plain == "elbow" || joint.plain == "wrist" || joint.plain == "hand";
        const std::string_view own = joint.side == Side::none ? "head_top" : is_arm ? "fingertip" : "toe";
        return off[face] == (limb.side == joint.side && limb.plain == own);
    });
}

/// Which faces are cut off. \throws Error bad_input when none of the cut's places and ways will do.
std::vector<bool> cut_off(const Soup& soup, const std::vector<Face>& beyond, const EndFaces& ends, const Cut& cut,
                          const KinematicSkeleton<double>& skeleton) {
    for (const double place : cut.places) {
        std::optional<CutFaces> shortest; // others may run along the limb, and leave some of it
        for (const Across across : {cut.across, Across::both_bones, Across::last_bone, Across::next_bone}) {
            auto faces = faces_beyond(soup, beyond, plane_of(cut, across, place, skeleton));
            if (faces && takes_off(faces->off, cut, ends) && (!shortest || faces->rim < shortest->rim))
                shortest = std::move(faces);
        }
        if (shortest) return shortest->off;
    }
    throw Error(ErrorCode::bad_input,
                std::string("the ") + limb_names[cut.limb] + " cannot be cut off: no ring around it parts the surface");
}

} // namespace

std::vector<std::size_t> cut_limbs(const Soup& soup, const KinematicSkeleton<double>& skeleton) {
    const std::vector<Face> beyond = neighbours(soup.faces);
    const EndFaces ends = faces_at_ends(soup, skeleton);
    std::vector<std::size_t> limb(soup.faces.size(), 0);
    for (const Cut& cut : cuts()) {
        const std::vector<bool> off = cut_off(soup, beyond, ends, cut, skeleton);
        for (std::size_t f = 0; f < limb.size(); ++f)
            if (off[f]) limb[f] = cut.limb;
    }
    return limb;
}

Vec3 joint_position(const KinematicSkeleton<double>& skeleton, const std::string& name) {
    const int joint = find_joint(skeleton, name);
    if (joint < 0) throw Error(ErrorCode::bad_input, "the skeleton has no joint " + name);
    return skeleton.joints[static_cast<std::size_t>(joint)].position;
}

} // namespace skelgen::damage
