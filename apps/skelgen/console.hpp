#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

#include <skelgen/core/error.hpp>

namespace skelgen::cli {

/// Prints "skelgen: error: WHAT" on standard error, on one line whatever WHAT holds.
void print_error(std::string_view what);

/// Prints "skelgen: warning: WHAT" likewise.
void print_warning(std::string_view what);

/// The same of what is good to know and no reason to worry.
void print_note(std::string_view what);

/// Writes a result to the file, wholly or not at all; to standard output if `path` is empty or "-".
/// \throws Error with `io::write_error_code`, its text beginning with the file's name, when it cannot be written.
void write_result(const std::string& path, std::string_view text);

/// Makes a folder and those above it, where they are not there.
/// \throws Error with `io::write_error_code`, its text beginning with the folder's name, when that cannot be done.
void make_folder(const std::filesystem::path& folder);

/// Refuses a file that is to be written where no folder is: before the long work, and not after it. An empty name and
/// "-" are no files. \throws Error usage.
void require_folder_of(const std::string& output);

/// The place that a path names, whatever way it is written.
[[nodiscard]] std::filesystem::path place_of(const std::filesystem::path& file);

/// Refuses to replace the input by the output.
/// \throws Error usage when both are the same file.
void require_different_files(const std::filesystem::path& input, const std::string& output);

/// Refuses to write two results to one file; an empty name and "-" are none.
/// \throws Error usage when both are the same file, there or not; the text names the options that gave them.
void require_different_outputs(const std::string& a, const std::string& option_a, const std::string& b,
                               const std::string& option_b);

/// Does `work`; what it throws becomes an Error with the name of the file it is about in front.
template <typename Work>
auto in_file(const std::filesystem::path& file, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code(), file.string() + ": " + error.what(), error.refusal());
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::internal, file.string() + ": out of memory; use a smaller mesh or a larger machine");
    } catch (const std::exception& error) {
        throw Error(ErrorCode::internal,
                    file.string() + ": a fault of skelgen's own, please report it: " + error.what());
    }
}

} // namespace skelgen::cli
