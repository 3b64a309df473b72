#pragma once

#include <string_view>

namespace skelgen::cli {

/// The page that `view` fills with bodies: apps/view made one file of HTML by apps/view/bundle.mjs, as io::view_page
/// takes it.
[[nodiscard]] std::string_view view_bundle();

} // namespace skelgen::cli
