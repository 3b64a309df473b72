#pragma once

#include <string>
#include <string_view>

namespace skelgen::io::detail {

/// GLB (Khr21 section 4): a scene's JSON and the bytes of its one buffer. Linear.
/// \throws Error usage when both together are 4 GiB or larger.
[[nodiscard]] std::string format_glb_container(std::string json, std::string_view data);

} // namespace skelgen::io::detail
