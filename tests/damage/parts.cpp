#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

#include <skelgen/core/geometry.hpp>

#include "damages.hpp"
#include "limbs.hpp"

namespace skelgen::damage {
namespace {

Vec3 middle(const Soup& soup, const std::vector<int>& loop) {
    Vec3 sum = Vec3::Zero();
    for (const int v : loop) sum += soup.at(v);
    return sum / static_cast<double>(loop.size());
}

/// Closes a boundary loop by a fan around a new vertex.
void add_cap(Soup& soup, const std::vector<int>& loop) {
    const int tip = soup.add(middle(soup, loop));
    for (std::size_t i = 0; i < loop.size(); ++i) soup.faces.push_back({loop[(i + 1) % loop.size()], loop[i], tip});
}

/// Of each vertex the distance along the edges to the nearest vertex of these faces; no farther than `most` is looked.
std::vector<double> distances_from(const Soup& soup, const std::vector<bool>& is_in, double most) {
    std::vector<std::vector<int>> edges(soup.vertices.size());
    std::vector<double> distance(soup.vertices.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> front;
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const int v = soup.faces[f][k];
            edges[static_cast<std::size_t>(v)].push_back(soup.faces[f][(k + 1) % 3]);
            edges[static_cast<std::size_t>(v)].push_back(soup.faces[f][(k + 2) % 3]);
            if (!is_in[f] || distance[static_cast<std::size_t>(v)] == 0) continue;
            distance[static_cast<std::size_t>(v)] = 0;
            front.emplace(0.0, v);
        }
    while (!front.empty()) {
        const auto [d, v] = front.top();
        front.pop();
        if (d > distance[static_cast<std::size_t>(v)]) continue;
        for (const int w : edges[static_cast<std::size_t>(v)]) {
            const double longer = d + (soup.at(w) - soup.at(v)).norm();
            if (longer > most || longer >= distance[static_cast<std::size_t>(w)]) continue;
            distance[static_cast<std::size_t>(w)] = longer;
            front.emplace(longer, w);
        }
    }
    return distance;
}

/// These faces, grown by `overlap` into what they were cut off from, narrower there so that they end inside of it, and
/// closed.
Soup closed_part(const Soup& soup, const Points<double>& normals, const std::vector<bool>& is_in, double overlap) {
    constexpr double taper = 0.3; // inwards, of the way beyond the cut
    const std::vector<double> distance = distances_from(soup, is_in, overlap);
    Soup part{soup.vertices, {}};
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        const Face& face = soup.faces[f];
        const auto is_near = [&](int v) { return distance[static_cast<std::size_t>(v)] <= overlap; };
        if (is_in[f] || std::all_of(face.begin(), face.end(), is_near)) part.faces.push_back(face);
    }
    for (std::size_t v = 0; v < distance.size(); ++v)
        if (distance[v] <= overlap)
            part.vertices[v] -= taper * distance[v] * normals.row(static_cast<Eigen::Index>(v)).transpose();
    for (const std::vector<int>& loop : boundary_loops(part.faces)) add_cap(part, loop);
    return to_soup(to_compact_mesh(part));
}

void append(Soup& soup, const Soup& other) {
    const int offset = static_cast<int>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const Face& face : other.faces) soup.faces.push_back({face[0] + offset, face[1] + offset, face[2] + offset});
}

/// `part_of_limb`: limbs with the same number stay together.
Mesh overlapping_parts(const Subject& subject, const std::array<std::size_t, limb_count>& part_of_limb) {
    constexpr double overlap = 0.02; // of the diagonal: two finger's breadths
    const Soup soup = to_soup(subject.mesh);
    const Points<double> normals = core::vertex_normals(subject.mesh);
    const std::vector<std::size_t> limb = cut_limbs(soup, *subject.skeleton);
    Soup out;
    for (std::size_t part = 0; part <= *std::max_element(part_of_limb.begin(), part_of_limb.end()); ++part) {
        std::vector<bool> is_in;
        for (const std::size_t l : limb) is_in.push_back(part_of_limb[l] == part);
        append(out, closed_part(soup, normals, is_in, overlap * core::bounding_diagonal(subject.mesh.vertices)));
    }
    return to_mesh(out);
}

} // namespace

Mesh parts_14(const Subject& subject) {
    return overlapping_parts(subject, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13});
}

Mesh parts_4(const Subject& subject) { return overlapping_parts(subject, {0, 1, 0, 0, 0, 0, 0, 0, 2, 2, 2, 3, 3, 3}); }

Mesh inner_walls(const Subject& subject) {
    Soup soup = to_soup(subject.mesh);
    const std::vector<Face> faces = soup.faces;
    const std::vector<std::size_t> limb = cut_limbs(soup, *subject.skeleton);
    for (std::size_t l = 1; l < limb_count; ++l) {
        // The limb with all that hangs on it: hands and feet follow their arms and legs.
        const std::size_t end = l == 1 ? 2 : l + 3 - (l - 2) % 3;
        std::vector<Face> beyond;
        for (std::size_t f = 0; f < faces.size(); ++f)
            if (limb[f] >= l && limb[f] < end) beyond.push_back(faces[f]);
        for (const std::vector<int>& loop : boundary_loops(beyond)) add_cap(soup, loop);
    }
    return to_mesh(soup);
}

} // namespace skelgen::damage
