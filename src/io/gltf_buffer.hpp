#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "json_values.hpp"

namespace skelgen::io::detail {

/// What a bufferView is for: OpenGL's numbers.
enum class GltfTarget { none = 0, vertices = 34962, indices = 34963 };

/// Rows of floats, one per vertex, key or joint.
using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The one buffer of a glTF scene that is being written, with its views and accessors; each `add_...` appends to it and
/// returns the index of the accessor, or of the view, that tells what was added.
class GltfBuffer {
public:
    /// Rows of 1, 2, 3, 4 or 16 numbers. `limits`: with the least and the greatest of each column, as glTF wants it of
    /// positions and times.
    std::size_t add_floats(const FloatRows& rows, GltfTarget target, bool limits = false);
    /// `count` rows of 3 numbers that are zero but for those at `places`, which rise: none but these are stored where
    /// they are few.
    std::size_t add_sparse_floats(std::span<const std::uint32_t> places, const FloatRows& rows, std::size_t count,
                                  bool limits);
    /// Of triangles.
    std::size_t add_indices(std::span<const std::uint32_t> indices);
    /// Rows of four joints.
    std::size_t add_joints(std::span<const std::uint16_t> joints);
    /// The bytes of a picture: a view alone.
    std::size_t add_bytes(std::string_view bytes);

    /// Writes "accessors", "bufferViews" and "buffers" into a scene.
    void describe_in(Json& scene) const;
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::size_t add_view(std::size_t begin, GltfTarget target);
    std::size_t zeros_view(std::size_t count);
    std::size_t add_accessor(int component_type, std::size_t count, const char* type, std::size_t begin,
                             GltfTarget target);

    std::string bytes_;
    Json views_ = Json::array(), accessors_ = Json::array();
    std::map<std::size_t, std::size_t> zeros_; ///< by number of rows of three
};

} // namespace skelgen::io::detail
