#pragma once

#include <string>
#include <string_view>

namespace skelgen::io::detail {

/// An FBX file in which no two nodes have the same name, as long as they were: of several the first keeps it. The
/// library that reads FBX knows bones by their names alone, and would move what follows one as the other. Files older
/// than version 7, whose nodes are told by their names, and what is damaged stay as they are. Linear.
[[nodiscard]] std::string with_names_apart(std::string_view fbx);

/// The version that an FBX file says it has, as 7400; 0 where it says none.
[[nodiscard]] int version_of_fbx(std::string_view fbx);

} // namespace skelgen::io::detail
