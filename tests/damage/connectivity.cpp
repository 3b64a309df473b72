#include <algorithm>
#include <deque>
#include <map>

#include "damages.hpp"

namespace skelgen::damage {
namespace {

/// For each face the nearest of `seeds`, counted in faces; pieces without a seed belong to the first one.
std::vector<std::size_t> nearest_seed(const std::vector<Face>& beyond, const std::vector<std::size_t>& seeds) {
    std::vector<int> label(beyond.size(), -1);
    std::deque<std::size_t> front;
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        label[seeds[s]] = static_cast<int>(s);
        front.push_back(seeds[s]);
    }
    for (; !front.empty(); front.pop_front())
        for (const int neighbour : beyond[front.front()])
            if (neighbour >= 0 && label[static_cast<std::size_t>(neighbour)] < 0) {
                label[static_cast<std::size_t>(neighbour)] = label[front.front()];
                front.push_back(static_cast<std::size_t>(neighbour));
            }
    std::vector<std::size_t> out;
    for (const int l : label) out.push_back(static_cast<std::size_t>(std::max(l, 0)));
    return out;
}

/// Faces far from each other: each the farthest from those before it, as the crow flies.
std::vector<std::size_t> spread_faces(const Soup& soup, std::size_t count, std::size_t first) {
    std::vector<std::size_t> chosen{first};
    std::vector<double> distance(soup.faces.size(), std::numeric_limits<double>::infinity());
    while (chosen.size() < count) {
        const Vec3 last = centroid(soup, soup.faces[chosen.back()]);
        for (std::size_t f = 0; f < distance.size(); ++f)
            distance[f] = std::min(distance[f], (centroid(soup, soup.faces[f]) - last).norm());
        chosen.push_back(
            static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin()));
    }
    return chosen;
}

} // namespace

Mesh triangle_soup(const Subject& subject) {
    const Soup soup = to_soup(subject.mesh);
    Soup out;
    for (const Face& face : soup.faces) {
        const int a = out.add(soup.at(face[0])), b = out.add(soup.at(face[1])), c = out.add(soup.at(face[2]));
        out.faces.push_back({a, b, c});
    }
    return to_mesh(out);
}

Mesh six_charts(const Subject& subject) {
    constexpr std::size_t charts = 6;
    const Soup soup = to_soup(subject.mesh);
    Dice dice(subject.seed);
    const std::vector<std::size_t> chart =
        nearest_seed(neighbours(soup.faces), spread_faces(soup, charts, dice.index(soup.faces.size())));
    Soup out;
    std::map<std::pair<std::size_t, int>, int> own; // a chart's vertex for one of the body's
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        Face face = soup.faces[f];
        for (int& v : face) {
            const auto [place, is_new] = own.try_emplace({chart[f], v}, static_cast<int>(out.vertices.size()));
            if (is_new) out.add(soup.at(v));
            v = place->second;
        }
        out.faces.push_back(face);
    }
    return to_mesh(out);
}

Mesh duplicates(const Subject& subject) {
    constexpr double vertices = 0.05, faces = 0.1;
    Soup soup = to_soup(subject.mesh);
    Dice dice(subject.seed);
    std::vector<int> twin(soup.vertices.size(), -1);
    for (const std::size_t v : dice.sample(soup.vertices.size(), vertices)) twin[v] = soup.add(soup.vertices[v]);
    for (Face& face : soup.faces)
        for (int& v : face) // about half of the faces around it take the twin
            if (const int other = twin[static_cast<std::size_t>(v)]; other >= 0 && dice.uniform() < 0.5) v = other;
    for (const std::size_t f : dice.sample(soup.faces.size(), faces)) {
        Face again = soup.faces[f];
        std::rotate(again.begin(), again.begin() + static_cast<std::ptrdiff_t>(dice.index(3)), again.end());
        soup.faces.push_back(again);
    }
    return to_mesh(soup);
}

Mesh degenerate(const Subject& subject) {
    constexpr double part = 0.01; // of the faces, for each of the three ways
    Soup soup = to_soup(subject.mesh);
    Dice dice(subject.seed);
    const std::size_t count = soup.faces.size();
    // A corner named twice.
    for (const std::size_t f : dice.sample(count, part))
        soup.faces.push_back({soup.faces[f][0], soup.faces[f][1], soup.faces[f][1]});
    // A needle on an edge, to a vertex in the middle of it.
    for (const std::size_t f : dice.sample(count, part)) {
        const Face face = soup.faces[f];
        soup.faces.push_back({face[1], face[0], soup.add(0.5 * (soup.at(face[0]) + soup.at(face[1])))});
    }
    // Two vertices in one place: the faces along their edge lose their area.
    for (const std::size_t f : dice.sample(count, part))
        soup.vertices[static_cast<std::size_t>(soup.faces[f][0])] = soup.at(soup.faces[f][1]);
    return to_mesh(soup);
}

Mesh fins(const Subject& subject) {
    constexpr double part = 0.02, height = 2; // edge lengths
    Soup soup = to_soup(subject.mesh);
    Dice dice(subject.seed);
    for (const std::size_t f : dice.sample(soup.faces.size(), part)) {
        const Face face = soup.faces[f];
        const Vec3 a = soup.at(face[0]), b = soup.at(face[1]);
        const Vec3 out = normal(soup, face).normalized() * (b - a).norm() * height;
        soup.faces.push_back({face[0], face[1], soup.add(0.5 * (a + b) + out)});
    }
    return to_mesh(soup);
}

} // namespace skelgen::damage
