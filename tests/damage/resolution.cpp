#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <map>

#include "cgal_mesh.hpp"
#include "damages.hpp"

namespace skelgen::damage {
namespace {

/// Edge by edge, each where it changes the shape least (the cost of Lindstrom and Turk).
Mesh decimated(const Mesh& mesh, std::size_t faces) {
    namespace simplification = CGAL::Surface_mesh_simplification;
    CgalMesh work = to_cgal(mesh);
    const std::size_t edges = faces * 3 / 2;
    simplification::edge_collapse(work, simplification::Count_stop_predicate<CgalMesh>(edges));
    return from_cgal(work);
}

/// Each face into four at the middles of its edges.
Soup in_four(const Soup& soup) {
    Soup out{soup.vertices, {}};
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
        const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), 0);
        if (is_new) place->second = out.add(0.5 * (soup.at(a) + soup.at(b)));
        return place->second;
    };
    for (const auto& [a, b, c] : soup.faces) {
        const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        out.faces.insert(out.faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    return out;
}

/// The largest faces into three around their centroids, until there are `faces`.
void split_largest(Soup& soup, std::size_t faces) {
    std::vector<std::pair<double, std::size_t>> by_area;
    for (std::size_t f = 0; f < soup.faces.size(); ++f) by_area.emplace_back(-normal(soup, soup.faces[f]).norm(), f);
    std::sort(by_area.begin(), by_area.end());
    for (const auto& [area, f] : by_area) {
        if (soup.faces.size() + 2 > faces) return;
        const auto [a, b, c] = soup.faces[f];
        const int tip = soup.add(centroid(soup, soup.faces[f]));
        soup.faces[f] = {a, b, tip};
        soup.faces.push_back({b, c, tip});
        soup.faces.push_back({c, a, tip});
    }
}

} // namespace

Mesh faces_3000(const Subject& subject) { return decimated(subject.mesh, 3000); }
Mesh faces_1000(const Subject& subject) { return decimated(subject.mesh, 1000); }
Mesh faces_500(const Subject& subject) { return decimated(subject.mesh, 500); }

Mesh faces_400000(const Subject& subject) {
    constexpr std::size_t wanted = 400'000;
    Soup soup = to_soup(subject.mesh);
    while (soup.faces.size() * 4 <= wanted) soup = in_four(soup);
    split_largest(soup, wanted);
    return to_mesh(soup);
}

} // namespace skelgen::damage
