#pragma once

#include <filesystem>
#include <string_view>

#include <skelgen/core/error.hpp>

namespace skelgen::io {

/// Whose fault it is that a file cannot be written, by the system's error number: `not_written` for a full disk, an
/// exceeded quota, a failing device or a reader that is gone; `usage` for a place that cannot be written to at all,
/// such as a folder that does not exist or may not be changed.
[[nodiscard]] ErrorCode write_error_code(int error);

/// Writes `content` to `path` so that a reader sees the whole file or none of it: it goes to a temporary name in the
/// same folder (.skelgen-<process>-<number>.tmp), which is then renamed over `path`. A file that was there is replaced
/// and keeps its permissions; a symbolic link keeps pointing where it did. What is no regular file (/dev/stdout,
/// /dev/null, a named pipe) is written to directly. Missing folders are not made. Not synced to the disk: a power cut
/// may still lose the file.
/// \throws Error with `write_error_code` when it cannot be written; nothing is left behind then, and a file that was
///         there is untouched.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// Removes the temporary files that `write_file_atomically` could not clean up in `folder` because its process was
/// killed; those of processes that still run stay. Does nothing if the folder cannot be read.
void remove_leftovers(const std::filesystem::path& folder);

} // namespace skelgen::io
