#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace skelgen::io::detail {

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

/// A compressed part of a buffer, as glTF's extension EXT_meshopt_compression describes it.
struct MeshoptStream {
    std::string_view bytes;
    std::size_t count = 0;  ///< of rows
    std::size_t stride = 0; ///< bytes of a row
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
};

/// The count x stride bytes that the stream stands for. Linear in them; no more than 128 times the stream's.
/// \throws Error bad_input when the stream is damaged or stands for more than `most_bytes`, or this build lacks
///         meshoptimizer, which the message then says.
[[nodiscard]] std::string decode_meshopt(const MeshoptStream& stream, std::size_t most_bytes);

} // namespace skelgen::io::detail
