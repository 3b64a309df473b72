#include <skelgen/synth/scan_faults.hpp>

#include <array>
#include <random>
#include <set>
#include <vector>

#include <skelgen/core/geometry.hpp>

namespace skelgen::synth {
namespace {

using Vec3 = Vector3<double>;
using Face = std::array<int, 3>;

/// A mesh that can grow.
struct Soup {
    std::vector<Vec3> vertices;
    std::vector<Face> faces;
};

class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}

    double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

    /// Variance 1, nearly normal: the sum of twelve uniform numbers, the same on every machine.
    double normal() {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += uniform();
        return sum;
    }

    std::size_t index(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }

private:
    std::mt19937_64 random_;
};

Vec3 centre(const Soup& soup, const Face& face) {
    Vec3 sum = Vec3::Zero();
    for (const int v : face) sum += soup.vertices[static_cast<std::size_t>(v)];
    return sum / 3;
}

/// Faces within `radius` of a random one.
std::vector<std::size_t> random_patch(const Soup& soup, double radius, Dice& dice) {
    const Vec3 middle = centre(soup, soup.faces[dice.index(soup.faces.size())]);
    std::vector<std::size_t> patch;
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        if ((centre(soup, soup.faces[f]) - middle).norm() < radius) patch.push_back(f);
    return patch;
}

void add_floating_piece(Soup& soup, const std::vector<std::size_t>& patch, Dice& dice) {
    const Vec3 away(0.15 + 0.1 * dice.uniform(), 0.2 + 0.1 * dice.uniform(), 0.1 * dice.uniform());
    std::vector<int> copy(soup.vertices.size(), -1);
    for (const std::size_t f : patch) {
        Face face = soup.faces[f];
        for (int& v : face) {
            int& copied = copy[static_cast<std::size_t>(v)];
            if (copied < 0) {
                copied = static_cast<int>(soup.vertices.size());
                soup.vertices.push_back(soup.vertices[static_cast<std::size_t>(v)] + away);
            }
            v = copied;
        }
        soup.faces.push_back(face);
    }
}

void remove_faces(Soup& soup, const std::vector<std::size_t>& patch) {
    for (auto f = patch.rbegin(); f != patch.rend(); ++f)
        soup.faces.erase(soup.faces.begin() + static_cast<std::ptrdiff_t>(*f));
}

/// Vertices that share a face with one that shares a face with v.
std::set<int> second_ring(const Soup& soup, int v) {
    std::set<int> ring{v};
    for (int step = 0; step < 2; ++step) {
        const std::set<int> inner = ring;
        for (const Face& face : soup.faces)
            for (const int corner : face)
                if (inner.count(corner) > 0) ring.insert(face.begin(), face.end());
    }
    return ring;
}

/// Makes a random vertex and the nearest one beyond its second ring one.
void pinch(Soup& soup, Dice& dice) {
    const int kept = soup.faces[dice.index(soup.faces.size())][0];
    const std::set<int> ring = second_ring(soup, kept);
    int nearest = -1;
    double distance = 0;
    for (const Face& face : soup.faces)
        for (const int v : face) {
            const double d =
                (soup.vertices[static_cast<std::size_t>(v)] - soup.vertices[static_cast<std::size_t>(kept)]).norm();
            if (ring.count(v) == 0 && (nearest < 0 || d < distance)) nearest = v, distance = d;
        }
    for (Face& face : soup.faces)
        for (int& v : face)
            if (v == nearest) v = kept;
}

Soup noisy_soup(const TriangleMesh<double>& mesh, double noise, Dice& dice) {
    Soup soup;
    const Points<double> normals = core::vertex_normals(mesh);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        soup.vertices.emplace_back(mesh.vertices.row(v) + noise * dice.normal() * normals.row(v));
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        soup.faces.push_back({mesh.faces(f, 0), mesh.faces(f, 1), mesh.faces(f, 2)});
    return soup;
}

/// Without the vertices that no face uses.
TriangleMesh<double> compact(const Soup& soup) {
    std::vector<int> renamed(soup.vertices.size(), -1);
    for (const Face& face : soup.faces)
        for (const int v : face) renamed[static_cast<std::size_t>(v)] = 0;
    int count = 0;
    for (int& name : renamed)
        if (name == 0) name = count++;
    TriangleMesh<double> mesh;
    mesh.vertices.resize(count, 3);
    mesh.faces.resize(static_cast<Eigen::Index>(soup.faces.size()), 3);
    for (std::size_t v = 0; v < renamed.size(); ++v)
        if (renamed[v] >= 0) mesh.vertices.row(renamed[v]) = soup.vertices[v];
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            mesh.faces(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)) =
                renamed[static_cast<std::size_t>(soup.faces[f][k])];
    return mesh;
}

} // namespace

TriangleMesh<double> with_scan_faults(const TriangleMesh<double>& mesh, const ScanFaults& faults) {
    Dice dice(faults.seed);
    Soup soup = noisy_soup(mesh, faults.noise, dice);
    const auto patch = [&] { return random_patch(soup, faults.patch_radius * (0.6 + 0.8 * dice.uniform()), dice); };
    for (int i = 0; i < faults.floating_pieces; ++i) add_floating_piece(soup, patch(), dice);
    for (int i = 0; i < faults.flipped_patches; ++i)
        for (const std::size_t f : patch()) std::swap(soup.faces[f][1], soup.faces[f][2]);
    for (int i = 0; i < faults.pinched_vertices; ++i) pinch(soup, dice);
    for (int i = 0; i < faults.holes; ++i) remove_faces(soup, patch());
    return compact(soup);
}

} // namespace skelgen::synth
