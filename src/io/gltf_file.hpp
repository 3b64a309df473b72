#pragma once

#include <optional>
#include <string_view>

#include "gltf_value.hpp"

namespace skelgen::io::detail {

/// A glTF 2.0 file (Khr21), which is JSON, or GLB's container around it and the bytes of its first buffer.
struct GltfFile { // NOLINT(bugprone-exception-escape): the JSON library asserts in its move, and never throws there
    GltfValue::Json json;
    std::optional<std::string_view> binary; ///< GLB's second chunk: a part of the bytes given

    [[nodiscard]] GltfValue root() const { return {json, ""}; }
    /// The element of one of the file's lists ("nodes") that `index` refers to.
    [[nodiscard]] GltfValue referred(const char* list, const GltfValue& index) const {
        return root().at(list)[index.whole_number()];
    }
    /// How many elements a list of the file has; none where the file lacks it.
    [[nodiscard]] std::size_t count(const char* list) const {
        const auto found = root().find(list);
        return found ? found->size() : 0;
    }
};

/// Whether the file begins as GLB or VRM do.
[[nodiscard]] bool is_glb(std::string_view bytes);

/// Whether it looks like glTF's JSON: an object that names its "asset" or other lists of glTF.
[[nodiscard]] bool is_gltf_json(std::string_view bytes);

/// Takes a file of either kind apart. Linear in its size.
/// \throws Error bad_input when it is cut short, is no JSON or nested too deeply, is of another version of glTF, or
/// needs
///         an extension that changes shapes in a way not known here.
[[nodiscard]] GltfFile open_gltf(std::string_view bytes);

} // namespace skelgen::io::detail
