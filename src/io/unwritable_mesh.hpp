#pragma once

#include <string>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {

/// What all writers of meshes say of one that their format cannot take. \throws Error usage, always.
[[noreturn]] inline void refuse_to_write_mesh(const std::string& reason) {
    throw Error(ErrorCode::usage, "the mesh cannot be written: " + reason);
}

} // namespace skelgen::io::detail
