#include "soup.hpp"

#include <algorithm>
#include <map>

namespace skelgen::damage {

Soup to_soup(const Mesh& mesh) {
    Soup soup;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) soup.vertices.emplace_back(mesh.vertices.row(v));
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        soup.faces.push_back({mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2)});
    return soup;
}

Mesh to_mesh(const Soup& soup) {
    Mesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(soup.vertices.size()), 3);
    mesh.faces.resize(static_cast<Eigen::Index>(soup.faces.size()), 3);
    for (std::size_t v = 0; v < soup.vertices.size(); ++v)
        mesh.vertices.row(static_cast<Eigen::Index>(v)) = soup.vertices[v];
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        mesh.faces.row(static_cast<Eigen::Index>(f)) << soup.faces[f][0], soup.faces[f][1], soup.faces[f][2];
    return mesh;
}

Mesh to_compact_mesh(const Soup& soup) {
    std::vector<int> renamed(soup.vertices.size(), -1);
    for (const Face& face : soup.faces)
        for (const int v : face) renamed[static_cast<std::size_t>(v)] = 0;
    Soup compact;
    for (std::size_t v = 0; v < renamed.size(); ++v)
        if (renamed[v] == 0) renamed[v] = compact.add(soup.vertices[v]);
    for (Face face : soup.faces) {
        for (int& v : face) v = renamed[static_cast<std::size_t>(v)];
        compact.faces.push_back(face);
    }
    return to_mesh(compact);
}

Vec3 centroid(const Soup& soup, const Face& face) {
    return (soup.at(face[0]) + soup.at(face[1]) + soup.at(face[2])) / 3;
}

Vec3 normal(const Soup& soup, const Face& face) {
    const Vec3& a = soup.at(face[0]);
    return (soup.at(face[1]) - a).cross(soup.at(face[2]) - a);
}

std::vector<Face> neighbours(const std::vector<Face>& faces) {
    struct Side {
        std::pair<int, int> edge;
        int face;
        std::size_t corner;
    };
    std::vector<Side> sides;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            sides.push_back({std::minmax({faces[f][k], faces[f][(k + 1) % 3]}), static_cast<int>(f), k});
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.face < b.face; });
    std::vector<Face> beyond(faces.size(), Face{-1, -1, -1});
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i;
        while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
        if (end == i + 2) {
            beyond[static_cast<std::size_t>(sides[i].face)][sides[i].corner] = sides[i + 1].face;
            beyond[static_cast<std::size_t>(sides[i + 1].face)][sides[i + 1].corner] = sides[i].face;
        }
        i = end;
    }
    return beyond;
}

std::vector<std::vector<int>> boundary_loops(const std::vector<Face>& faces) {
    std::map<std::pair<int, int>, int> count; // how many faces more run along an edge this way than the other
    for (const Face& face : faces)
        for (std::size_t k = 0; k < 3; ++k) {
            ++count[{face[k], face[(k + 1) % 3]}];
            --count[{face[(k + 1) % 3], face[k]}];
        }
    std::multimap<int, int> next;
    for (const auto& [edge, more] : count)
        if (more > 0) next.insert(edge);
    std::vector<std::vector<int>> loops;
    while (!next.empty()) {
        std::vector<int> loop;
        const int start = next.begin()->first;
        int v = start;
        do {
            const auto edge = next.find(v);
            if (edge == next.end()) break; // no closed chain: the faces are not oriented consistently
            loop.push_back(v);
            v = edge->second;
            next.erase(edge);
        } while (v != start);
        if (v == start && loop.size() > 2) loops.push_back(std::move(loop));
    }
    return loops;
}

} // namespace skelgen::damage
