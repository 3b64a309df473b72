#include <skelgen/io/part_looks.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace skelgen::io {
namespace {

/// The rows of those vertices that lie in a part's run of them, the first of which is `first`.
template <typename Rows>
Rows rows_of(const Rows& rows, const std::vector<int>& vertices, std::size_t begin, std::size_t count, int first) {
    if (rows.rows() == 0) return rows;
    Rows out(static_cast<Eigen::Index>(count), rows.cols());
    for (std::size_t i = 0; i < count; ++i)
        out.row(static_cast<Eigen::Index>(i)) = rows.row(vertices[begin + i] - first);
    return out;
}

/// Where the numbers from `first` to before `end` lie in a rising list, as a beginning and a count.
std::pair<std::size_t, std::size_t> range_of(const std::vector<int>& numbers, Eigen::Index first, Eigen::Index end) {
    const auto from = std::lower_bound(numbers.begin(), numbers.end(), static_cast<int>(first));
    const auto to = std::lower_bound(from, numbers.end(), static_cast<int>(end));
    return {static_cast<std::size_t>(from - numbers.begin()), static_cast<std::size_t>(to - from)};
}

/// Of a morph target what it does to the vertices that stay, by their own numbers.
MorphTarget morph_of(const MorphTarget& morph, const std::vector<int>& kept) {
    MorphTarget out;
    std::vector<int> rows;
    for (std::size_t i = 0; i < morph.vertices.size(); ++i) {
        const auto place = std::lower_bound(kept.begin(), kept.end(), morph.vertices[i]);
        if (place == kept.end() || *place != morph.vertices[i]) continue;
        out.vertices.push_back(static_cast<int>(place - kept.begin()));
        rows.push_back(static_cast<int>(i));
    }
    out.positions = morph.positions(rows, Eigen::all);
    if (morph.normals.rows() > 0) out.normals = morph.normals(rows, Eigen::all);
    return out;
}

/// The numbers of what stays of a part's vertices, and of the copies of these, which come behind all.
std::vector<int> with_copies(std::vector<int> vertices, const std::vector<int>& copies, int first) {
    const std::size_t own = vertices.size();
    for (std::size_t i = 0; i < copies.size(); ++i)
        if (std::binary_search(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(own), copies[i]))
            vertices.push_back(first + static_cast<int>(i));
    return vertices;
}

/// The copies and faces of looks by the numbers that their vertices have in this part.
SceneLooks with_part_faces(SceneLooks looks, const applications::OwnPart& part, const std::vector<int>& vertices) {
    const auto now = [&](int vertex) {
        return static_cast<int>(std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
    };
    std::vector<int> copies;
    const int first = static_cast<int>(looks.parts.front().vertices) - static_cast<int>(looks.copies.size());
    for (std::size_t i = part.vertices.size(); i < vertices.size(); ++i)
        copies.push_back(now(looks.copies[static_cast<std::size_t>(vertices[i] - first)]));
    looks.copies = std::move(copies);
    Triangles faces = looks.faces(part.faces, Eigen::all);
    looks.faces = faces.unaryExpr(now);
    return looks;
}

} // namespace

SceneLooks looks_of(const SceneLooks& looks, const applications::OwnPart& part) {
    SceneLooks out = looks;
    if (part.is_all || looks.parts.empty()) return out;
    std::vector<int> kept = part.vertices;
    if (!looks.copies.empty()) {
        const auto copies = static_cast<Eigen::Index>(looks.copies.size());
        kept = with_copies(part.vertices, looks.copies, static_cast<int>(looks.parts.front().vertices - copies));
        out = with_part_faces(std::move(out), part, kept);
    }
    for (SceneObject& object : out.objects)
        for (MorphTarget& morph : object.morphs) morph = morph_of(morph, part.vertices);
    for (ScenePart& one : out.parts) {
        const auto [face, faces] = range_of(part.faces, one.first_face, one.first_face + one.faces);
        const auto [vertex, vertices] = range_of(kept, one.first_vertex, one.first_vertex + one.vertices);
        const auto first = static_cast<int>(one.first_vertex);
        for (auto& set : one.texture_coordinates) set = rows_of(set, kept, vertex, vertices, first);
        one.colours = rows_of(one.colours, kept, vertex, vertices, first);
        one.normals = rows_of(one.normals, kept, vertex, vertices, first);
        one.first_face = static_cast<Eigen::Index>(face);
        one.faces = static_cast<Eigen::Index>(faces);
        one.first_vertex = static_cast<Eigen::Index>(vertex);
        one.vertices = static_cast<Eigen::Index>(vertices);
    }
    return out;
}

} // namespace skelgen::io
