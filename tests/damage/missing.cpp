#include <set>
#include <vector>

#include "damages.hpp"
#include "limbs.hpp"

namespace skelgen::damage {
namespace {

/// Without the faces of these limbs, numbered as in `limb_names`.
Mesh without_limbs(const Subject& subject, const std::set<std::size_t>& limbs) {
    const Soup soup = to_soup(subject.mesh);
    const std::vector<std::size_t> limb = cut_limbs(soup, *subject.skeleton);
    Soup out{soup.vertices, {}};
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        if (limbs.count(limb[f]) == 0) out.faces.push_back(soup.faces[f]);
    return to_compact_mesh(out);
}

} // namespace

Mesh no_hands(const Subject& subject) { return without_limbs(subject, {4, 7}); }
Mesh no_feet(const Subject& subject) { return without_limbs(subject, {10, 13}); }
Mesh no_arm(const Subject& subject) { return without_limbs(subject, {2, 3, 4}); }
Mesh no_leg(const Subject& subject) { return without_limbs(subject, {8, 9, 10}); }
Mesh no_head(const Subject& subject) { return without_limbs(subject, {1}); }

Mesh front_half(const Subject& subject) {
    const Soup soup = to_soup(subject.mesh);
    Soup out{soup.vertices, {}};
    for (const Face& face : soup.faces) {
        const Vec3 normal = (soup.at(face[1]) - soup.at(face[0])).cross(soup.at(face[2]) - soup.at(face[0]));
        if (normal.dot(subject.skeleton->frame.forward) > 0) out.faces.push_back(face);
    }
    return to_compact_mesh(out);
}

} // namespace skelgen::damage
