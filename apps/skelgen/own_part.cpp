#include "own_part.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <skelgen/surface/pieces.hpp>
#include <skelgen/surface/weld.hpp>

namespace skelgen::cli {
namespace {

/// Faces whose corners at the same place are the same vertex, and which of the original's they are.
struct WeldedFaces {
    TriangleMesh<double> mesh;
    std::vector<int> source;
    std::vector<bool> is_own; ///< per vertex: the body stands for it
};

WeldedFaces welded_faces(const FittedFile& file) {
    auto welded = surface::weld(file.mesh, 0.0);
    WeldedFaces out{{std::move(welded.mesh.vertices), {}}, {}, {}};
    const auto corner = [&](Eigen::Index f, int k) {
        return welded.placed[static_cast<std::size_t>(file.mesh.faces(f, k))];
    };
    out.mesh.faces.resize(file.mesh.faces.rows(), 3);
    Eigen::Index row = 0;
    for (Eigen::Index f = 0; f < file.mesh.faces.rows(); ++f) {
        const int a = corner(f, 0), b = corner(f, 1), c = corner(f, 2);
        if (a == b || b == c || c == a) continue; // shows nothing
        out.mesh.faces.row(row++) << a, b, c;
        out.source.push_back(static_cast<int>(f));
    }
    out.mesh.faces.conservativeResize(row, Eigen::NoChange);
    out.is_own.resize(static_cast<std::size_t>(out.mesh.vertices.rows()), false);
    const auto mark = [&](std::size_t v) {
        if (welded.placed[v] >= 0) out.is_own[static_cast<std::size_t>(welded.placed[v])] = true;
    };
    const Body<double>& body = file.found.body;
    for (const int v : body.source)
        if (v >= 0) mark(static_cast<std::size_t>(v));
    for (std::size_t v = 0; v < body.nearest.size(); ++v)
        if (body.nearest[v] >= 0) mark(v);
    return out;
}

/// The original's numbers of the faces that `chosen` has, which are some of the welded ones in their order.
std::vector<int> numbers_of(const Triangles& chosen, const WeldedFaces& welded) {
    std::vector<int> out;
    for (std::size_t f = 0; f < welded.source.size() && static_cast<Eigen::Index>(out.size()) < chosen.rows(); ++f)
        if (welded.mesh.faces.row(static_cast<Eigen::Index>(f)) == chosen.row(static_cast<Eigen::Index>(out.size())))
            out.push_back(welded.source[f]);
    return out;
}

/// The faces of that of the bodies in a mesh which most of a body's own vertices are on; none where there is one alone.
std::vector<int> own_faces(const WeldedFaces& welded) {
    std::vector<int> best;
    std::ptrdiff_t most = -1;
    int bodies = 1;
    for (int number = 1; number <= bodies; ++number) {
        const surface::BodyFaces faces = surface::faces_of_body(welded.mesh, number);
        bodies = faces.bodies;
        const auto corners = faces.faces.reshaped();
        const std::ptrdiff_t own = std::count_if(corners.begin(), corners.end(), [&](int v) {
            return static_cast<bool>(welded.is_own[static_cast<std::size_t>(v)]);
        });
        if (bodies == 1) return {};
        if (own <= most) continue;
        most = own;
        best = numbers_of(faces.faces, welded);
    }
    return best;
}

/// The body of a mesh as that of the part of it that has these vertices.
Body<double> body_of_part(Body<double> body, const std::vector<int>& vertices, Eigen::Index all) {
    std::vector<int> now(static_cast<std::size_t>(all), -1);
    for (std::size_t v = 0; v < vertices.size(); ++v) now[static_cast<std::size_t>(vertices[v])] = static_cast<int>(v);
    body.source = surface::composed(std::move(body.source), now);
    if (body.nearest.empty()) return body;
    std::vector<int> nearest;
    for (const int v : vertices) nearest.push_back(body.nearest[static_cast<std::size_t>(v)]);
    body.nearest = std::move(nearest);
    return body;
}

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

/// The numbers of what stays of a part's vertices, and of the copies of these, which come behind all.
std::vector<int> with_copies(std::vector<int> vertices, const std::vector<int>& copies, int first) {
    const std::size_t own = vertices.size();
    for (std::size_t i = 0; i < copies.size(); ++i)
        if (std::binary_search(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(own), copies[i]))
            vertices.push_back(first + static_cast<int>(i));
    return vertices;
}

/// The copies and faces of looks by the numbers that their vertices have in this part.
io::SceneLooks with_part_faces(io::SceneLooks looks, const OwnPart& part, const std::vector<int>& vertices) {
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

OwnPart keep_own_part(FittedFile& file) {
    OwnPart part;
    part.faces = own_faces(welded_faces(file));
    if (part.faces.empty()) return part;
    part.is_all = false;
    TriangleMesh<double> own{file.mesh.vertices, {}};
    own.faces.resize(static_cast<Eigen::Index>(part.faces.size()), 3);
    for (std::size_t i = 0; i < part.faces.size(); ++i)
        own.faces.row(static_cast<Eigen::Index>(i)) = file.mesh.faces.row(part.faces[i]);
    auto used = surface::used_part(own);
    file.found.body = body_of_part(std::move(file.found.body), used.source, file.mesh.vertices.rows());
    file.mesh = std::move(used.mesh);
    part.vertices = std::move(used.source);
    return part;
}

io::SceneLooks looks_of(const io::SceneLooks& looks, const OwnPart& part) {
    io::SceneLooks out = looks;
    if (part.is_all || looks.parts.empty()) return out;
    std::vector<int> kept = part.vertices;
    if (!looks.copies.empty()) {
        const auto copies = static_cast<Eigen::Index>(looks.copies.size());
        kept = with_copies(part.vertices, looks.copies, static_cast<int>(looks.parts.front().vertices - copies));
        out = with_part_faces(std::move(out), part, kept);
    }
    for (io::ScenePart& one : out.parts) {
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

} // namespace skelgen::cli
