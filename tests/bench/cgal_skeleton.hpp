#pragma once

#include <filesystem>
#include <memory>

#include <skelgen/core/mesh.hpp>

namespace skelgen::bench {

/// A mesh as CGAL's mean curvature flow skeletonization takes it, and that skeletonization. In a file of its own:
/// CGAL's headers take most of a minute to compile.
class CgalSkeletonizer {
public:
    /// Orients the faces alike and splits the vertices in which the surface is pinched, without which CGAL refuses.
    explicit CgalSkeletonizer(const TriangleMesh<double>& mesh);
    ~CgalSkeletonizer();
    CgalSkeletonizer(const CgalSkeletonizer&) = delete;
    CgalSkeletonizer& operator=(const CgalSkeletonizer&) = delete;

    /// Whether the repaired mesh meets CGAL's precondition.
    [[nodiscard]] bool is_closed() const;

    /// Extracts the curve skeleton with CGAL's default parameters; the number of its nodes.
    [[nodiscard]] std::size_t run() const;

private:
    struct Mesh;
    std::unique_ptr<Mesh> mesh_;
};

/// Reads a file as CGAL does; the number of its faces.
[[nodiscard]] std::size_t read_by_cgal(const std::filesystem::path& file);

} // namespace skelgen::bench
