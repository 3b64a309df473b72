#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "gltf_data.hpp"

/// Rows of numbers as glTF stores them (Khr21 section 3.6.2).
namespace skelgen::io::detail {

/// Where an accessor's rows lie and what they are made of.
struct GltfRows {
    std::size_t offset = 0; ///< of the first, in its view
    std::size_t stride = 0; ///< from one to the next; 0 when they lie side by side
    int component_type = 0; ///< 5120 to 5126, as OpenGL numbers them
    bool normalized = false;
};

/// Bytes that one number takes. Fails for what is no type of glTF; `place` is where it is named.
[[nodiscard]] std::size_t component_bytes(int component_type, const GltfValue& place);

/// How many numbers the type of an accessor ("VEC3") has.
[[nodiscard]] std::size_t component_count(const GltfValue& type);

/// Reads array.rows rows of array.columns numbers into `array.values`. Fails, naming `place`, when `bytes` do not hold
/// them all.
[[nodiscard]] GltfArray read_rows(GltfArray array, std::string_view bytes, const GltfRows& rows,
                                  const GltfValue& place);

} // namespace skelgen::io::detail
