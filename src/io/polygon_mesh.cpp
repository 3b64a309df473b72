#include <skelgen/io/polygon_mesh.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>

#include <skelgen/core/error.hpp>

namespace skelgen::io {
namespace {

using Triangle = std::array<int, 3>;
using Point2 = std::array<double, 2>;
using Point3 = Eigen::Vector3d;

[[noreturn]] void throw_bad_mesh(const std::string& message) {
    throw Error(ErrorCode::bad_input, message + "; repair or export the mesh again");
}

/// Twice the signed area of a triangle, positive when counter-clockwise.
double cross(const Point2& a, const Point2& b, const Point2& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Ear clipping that always takes the valid ear with the shortest diagonal. Keeps its buffers from polygon to polygon.
class EarClipper {
public:
    explicit EarClipper(const PolygonMesh& mesh) : mesh_(mesh) {}

    /// Appends the triangles of the polygon with these corners (4 or more) to `triangles`.
    void clip(std::span<const int> corners, std::vector<Triangle>& triangles) {
        start(corners);
        for (std::size_t left = corners.size(); left > 3; --left) {
            const std::size_t ear = best_ear();
            emit(corners, ear, triangles);
            remove(ear);
        }
        emit(corners, first_, triangles);
    }

private:
    static constexpr double not_an_ear = std::numeric_limits<double>::infinity();

    void start(std::span<const int> corners) {
        const std::size_t n = corners.size();
        place(corners);
        project();
        first_ = 0;
        next_.resize(n);
        previous_.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
        is_reflex_.assign(n, 0);
        reflex_corners_ = 0;
        for (std::size_t i = 0; i < n; ++i) set_reflex(i, turn(i) <= 0);
        diagonal_.resize(n);
        for (std::size_t i = 0; i < n; ++i) diagonal_[i] = ear_diagonal(i);
    }

    /// Corner positions relative to the first corner, scaled to size 1 lest products overflow or vanish.
    void place(std::span<const int> corners) {
        points_.resize(corners.size());
        for (std::size_t i = 0; i < corners.size(); ++i)
            points_[i] = Eigen::Map<const Point3>(&mesh_.coordinates[3 * static_cast<std::size_t>(corners[i])]);
        const Point3 origin = points_[0];
        double size = 0;
        for (Point3& point : points_) {
            point = point / 2 - origin / 2;
            size = std::max(size, point.cwiseAbs().maxCoeff());
        }
        if (size > 0)
            for (Point3& point : points_) point /= size;
    }

    /// Drops the axis along which the polygon's normal (Newell's, right for concave polygons) is longest, turned so
    /// that the polygon runs counter-clockwise. Unlike a rotation that is exact.
    void project() {
        Point3 normal = Point3::Zero();
        for (std::size_t i = 1; i + 1 < points_.size(); ++i) normal += points_[i].cross(points_[i + 1]);
        int axis = 0;
        normal.cwiseAbs().maxCoeff(&axis);
        int u = (axis + 1) % 3, v = (axis + 2) % 3;
        if (normal[axis] < 0) std::swap(u, v);
        flat_.resize(points_.size());
        for (std::size_t i = 0; i < points_.size(); ++i) flat_[i] = {points_[i][u], points_[i][v]};
    }

    [[nodiscard]] double turn(std::size_t i) const { return cross(flat_[previous_[i]], flat_[i], flat_[next_[i]]); }

    [[nodiscard]] double squared_diagonal(std::size_t i) const {
        return (points_[next_[i]] - points_[previous_[i]]).squaredNorm();
    }

    /// Squared length of the diagonal that cuts corner `i` off, or `not_an_ear` if it leaves the polygon.
    [[nodiscard]] double ear_diagonal(std::size_t i) const {
        const std::size_t a = previous_[i], c = next_[i];
        if (is_reflex_[i]) return not_an_ear;
        if (reflex_corners_ == 0) return squared_diagonal(i);
        for (std::size_t p = next_[c]; p != a; p = next_[p])
            if (is_reflex_[p] && covers(i, p)) return not_an_ear;
        return squared_diagonal(i);
    }

    /// Whether corner `p` lies in the triangle that `i` makes with its neighbours, its border included. A point that
    /// coincides with one of the triangle's corners (a slit to a hole) does not count.
    [[nodiscard]] bool covers(std::size_t i, std::size_t p) const {
        const Point2 &a = flat_[previous_[i]], &b = flat_[i], &c = flat_[next_[i]], &q = flat_[p];
        if (q == a || q == b || q == c) return false;
        return cross(a, b, q) >= 0 && cross(b, c, q) >= 0 && cross(c, a, q) >= 0;
    }

    /// The ear to cut next. A twisted or flat polygon may have no valid one: the shortest diagonal has to do then.
    [[nodiscard]] std::size_t best_ear() const {
        std::size_t best = first_;
        for (std::size_t i = next_[first_]; i != first_; i = next_[i])
            if (diagonal_[i] < diagonal_[best]) best = i;
        if (diagonal_[best] != not_an_ear) return best;
        for (std::size_t i = next_[first_]; i != first_; i = next_[i])
            if (squared_diagonal(i) < squared_diagonal(best)) best = i;
        return best;
    }

    void set_reflex(std::size_t i, bool reflex) {
        reflex_corners_ += static_cast<int>(reflex) - static_cast<int>(is_reflex_[i]);
        is_reflex_[i] = static_cast<char>(reflex);
    }

    /// Cutting an ear changes how its two neighbours turn and whether they are ears, and no other corner.
    void remove(std::size_t ear) {
        const std::size_t a = previous_[ear], c = next_[ear];
        next_[a] = c;
        previous_[c] = a;
        if (first_ == ear) first_ = c;
        set_reflex(ear, false); // it is no longer in the ring
        set_reflex(a, turn(a) <= 0);
        set_reflex(c, turn(c) <= 0);
        diagonal_[a] = ear_diagonal(a);
        diagonal_[c] = ear_diagonal(c);
    }

    void emit(std::span<const int> corners, std::size_t i, std::vector<Triangle>& triangles) const {
        triangles.push_back({corners[previous_[i]], corners[i], corners[next_[i]]});
    }

    const PolygonMesh& mesh_;
    std::vector<Point3> points_;
    std::vector<Point2> flat_;
    std::vector<std::size_t> next_, previous_; ///< the ring of corners not cut off yet
    std::vector<char> is_reflex_;              ///< per corner: whether the polygon turns the other way there, or not
    int reflex_corners_ = 0;                   ///< how many of those in the ring are
    std::vector<double> diagonal_;             ///< per corner: see ear_diagonal
    std::size_t first_ = 0;                    ///< any corner of the ring
};

void check_corners(const PolygonMesh& mesh) {
    const std::size_t vertices = mesh.coordinates.size() / 3;
    for (const int corner : mesh.corners)
        if (corner < 0 || static_cast<std::size_t>(corner) >= vertices)
            throw_bad_mesh("a face names vertex " + std::to_string(corner) + " (counted from 0), but there are " +
                           std::to_string(vertices) + " vertices");
}

void check_sizes(const PolygonMesh& mesh) {
    // Clipping takes the square of a polygon's corners; so much in all takes a second.
    constexpr double most_pairs = 4e8, few_corners = 100;
    double pairs = 0;
    std::size_t corners = 0;
    for (std::size_t face = 0; face < mesh.sizes.size(); ++face) {
        const int size = mesh.sizes[face];
        if (size < 3 || size > max_face_corners)
            throw_bad_mesh("face " + std::to_string(face) + " (counted from 0) has " + std::to_string(size) +
                           " corners; it must have 3 to " + std::to_string(max_face_corners));
        corners += static_cast<std::size_t>(size);
        if (size > few_corners) pairs += static_cast<double>(size) * static_cast<double>(size);
    }
    if (pairs > most_pairs)
        throw_bad_mesh("there are too many polygons with hundreds of corners to be cut into triangles");
    if (corners != mesh.corners.size())
        throw_bad_mesh("the faces' sizes add up to " + std::to_string(corners) + " corners, but there are " +
                       std::to_string(mesh.corners.size()));
}

void check(const PolygonMesh& mesh) {
    if (mesh.coordinates.empty() || mesh.coordinates.size() % 3 != 0) throw_bad_mesh("there are no vertices");
    if (mesh.coordinates.size() / 3 > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw_bad_mesh("there are more vertices than an int can count");
    if (mesh.sizes.empty())
        throw_bad_mesh(
            "there are no faces; of points alone a surface has to be made first (Poisson reconstruction, say)");
    check_sizes(mesh);
    check_corners(mesh);
}

template <typename Scalar>
Points<Scalar> cast_vertices(const std::vector<double>& coordinates) {
    using Source = Eigen::Map<const Points<double>>;
    const Source source(coordinates.data(), static_cast<Eigen::Index>(coordinates.size() / 3), 3);
    Points<Scalar> vertices = source.template cast<Scalar>();
    if (!vertices.allFinite())
        throw_bad_mesh("a coordinate is not a number, infinite or too large for the precision of the computation");
    return vertices;
}

bool names_a_vertex_twice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The corners without those that repeat the one before.
void copy_distinct(std::span<const int> corners, std::vector<int>& distinct) {
    distinct.clear();
    for (const int corner : corners)
        if (distinct.empty() || distinct.back() != corner) distinct.push_back(corner);
    while (distinct.size() > 1 && distinct.front() == distinct.back()) distinct.pop_back();
}

/// Calls `take(triangles, face)` with what each face becomes, in their order. Triangles may name a vertex twice.
template <typename Take>
void cut_into_triangles(const PolygonMesh& mesh, const Take& take) {
    std::vector<Triangle> triangles;
    EarClipper clipper(mesh);
    std::vector<int> distinct;
    const int* corner = mesh.corners.data();
    for (std::size_t face = 0; face < mesh.sizes.size(); ++face) {
        const int size = mesh.sizes[face];
        triangles.clear();
        if (size == 3) {
            triangles.push_back({corner[0], corner[1], corner[2]});
        } else {
            copy_distinct({corner, static_cast<std::size_t>(size)}, distinct);
            if (distinct.size() == 3) triangles.push_back({distinct[0], distinct[1], distinct[2]});
            if (distinct.size() > 3) clipper.clip(distinct, triangles);
        }
        take(triangles, static_cast<int>(face));
        corner += size;
    }
}

/// The triangles in a row, without those that name a vertex twice. \throws Error bad_input when there are none.
Triangles sound_triangles(const PolygonMesh& mesh, std::vector<int>* source) {
    std::vector<Triangle> all;
    all.reserve(mesh.corners.size() - 2 * mesh.sizes.size());
    cut_into_triangles(mesh, [&](const std::vector<Triangle>& triangles, int face) {
        for (const Triangle& triangle : triangles) {
            if (names_a_vertex_twice(triangle)) continue;
            all.push_back(triangle);
            if (source != nullptr) source->push_back(face);
        }
    });
    if (all.empty()) throw_bad_mesh("there are no faces with three different corners");
    return Eigen::Map<const Triangles>(all.data()->data(), static_cast<Eigen::Index>(all.size()), 3);
}

} // namespace

template <typename Scalar>
TriangleMesh<Scalar> triangulate(const PolygonMesh& polygons) {
    check(polygons);
    TriangleMesh<Scalar> mesh;
    mesh.vertices = cast_vertices<Scalar>(polygons.coordinates);
    mesh.faces = sound_triangles(polygons, nullptr);
    return mesh;
}

CutPolygons cut_polygons(const PolygonMesh& polygons) {
    check(polygons);
    CutPolygons cut;
    cut.triangles = sound_triangles(polygons, &cut.source);
    return cut;
}

template TriangleMesh<float> triangulate<float>(const PolygonMesh&);
template TriangleMesh<double> triangulate<double>(const PolygonMesh&);

} // namespace skelgen::io
