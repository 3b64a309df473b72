#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::damage {

using Mesh = TriangleMesh<double>;
using Vec3 = Vector3<double>;
using Face = std::array<int, 3>;

/// A mesh that can grow.
struct Soup {
    std::vector<Vec3> vertices;
    std::vector<Face> faces;

    [[nodiscard]] const Vec3& at(int vertex) const { return vertices[static_cast<std::size_t>(vertex)]; }
    /// Adds a vertex; its index.
    int add(const Vec3& p) {
        vertices.push_back(p);
        return static_cast<int>(vertices.size()) - 1;
    }
};

[[nodiscard]] Soup to_soup(const Mesh& mesh);

/// All vertices come with it, used or not.
[[nodiscard]] Mesh to_mesh(const Soup& soup);

/// Without the vertices that no face uses.
[[nodiscard]] Mesh to_compact_mesh(const Soup& soup);

[[nodiscard]] Vec3 centroid(const Soup& soup, const Face& face);

/// Twice the area vector: outward for counter-clockwise faces.
[[nodiscard]] Vec3 normal(const Soup& soup, const Face& face);

/// For each face and each of its edges k (from corner k to k + 1) the face beyond it; -1 where there is none, or more
/// than one. O(faces log faces).
[[nodiscard]] std::vector<Face> neighbours(const std::vector<Face>& faces);

/// Edges that faces run along in one direction only, chained into closed loops; each loop lists its vertices in the
/// faces' direction. O(faces log faces).
[[nodiscard]] std::vector<std::vector<int>> boundary_loops(const std::vector<Face>& faces);

/// The same numbers on every machine.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}

    double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; } ///< from 0 to below 1

    /// Mean 0, variance 1, nearly normal: the sum of twelve uniform numbers.
    double normal() {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += uniform();
        return sum;
    }

    std::size_t index(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }

    Vec3 direction() {
        const double x = normal(), y = normal(), z = normal();
        return Vec3(x, y, z).normalized();
    }

    /// `part` (0 to 1) of the numbers 0 to count - 1, each once, in random order.
    std::vector<std::size_t> sample(std::size_t count, double part) {
        std::vector<std::size_t> all(count);
        for (std::size_t i = 0; i < count; ++i) all[i] = i;
        for (std::size_t i = count; i-- > 1;) std::swap(all[i], all[index(i + 1)]);
        all.resize(static_cast<std::size_t>(part * static_cast<double>(count) + 0.5));
        return all;
    }

private:
    std::mt19937_64 random_;
};

} // namespace skelgen::damage
