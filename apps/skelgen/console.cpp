#include "console.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <unistd.h>

#include <skelgen/io/atomic_file.hpp>

#include "progress_bar.hpp"

namespace skelgen::cli {
namespace {

/// File names and messages of other libraries may hold anything; scripts count on one line per message.
void print_line(std::string_view kind, std::string_view what) {
    std::string line = "skelgen: " + std::string(kind) + ": " + std::string(what);
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    line += '\n';
    if (::isatty(STDERR_FILENO) == 1) line.insert(0, clear_line); // a progress bar may be there
    std::fwrite(line.data(), 1, line.size(), stderr);
}

void write_to_standard_output(std::string_view text) {
    errno = 0;
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (written && std::fflush(stdout) == 0) return;
    throw Error(ErrorCode::not_written, "standard output: cannot be written: " +
                                            std::generic_category().message(errno) + "; name a file with -o");
}

} // namespace

void print_error(std::string_view what) { print_line("error", what); }

void print_warning(std::string_view what) { print_line("warning", what); }

void print_note(std::string_view what) { print_line("note", what); }

void write_result(const std::string& path, std::string_view text) {
    if (path.empty() || path == "-") return write_to_standard_output(text);
    in_file(path, [&] { io::write_file_atomically(path, text); });
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error && std::filesystem::is_directory(folder)) return;
    throw Error(error ? io::write_error_code(error.value()) : ErrorCode::usage,
                folder.string() + ": cannot be made a folder: " + (error ? error.message() : "it is a file") +
                    "; choose another one");
}

void require_folder_of(const std::string& output) {
    if (output.empty() || output == "-") return;
    std::error_code error;
    if (!std::filesystem::is_directory(std::filesystem::absolute(output, error).parent_path(), error))
        throw Error(ErrorCode::usage,
                    output + ": cannot be written: its folder does not exist; make it first, or choose another "
                             "output file");
}

std::filesystem::path place_of(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
}

void require_different_files(const std::filesystem::path& input, const std::string& output) {
    std::error_code error; // of files that are not there: they are not the same
    if (std::filesystem::is_regular_file(output, error) && std::filesystem::equivalent(input, output, error))
        throw Error(ErrorCode::usage, output + ": is the input; choose another output file");
}

void require_different_outputs(const std::string& a, const std::string& option_a, const std::string& b,
                               const std::string& option_b) {
    if (a.empty() || b.empty() || a == "-" || b == "-") return;
    std::error_code error;
    if (place_of(a) == place_of(b) && std::filesystem::status(a, error).type() != std::filesystem::file_type::character)
        throw Error(ErrorCode::usage, a + ": is given to " + option_a + " and to " + option_b +
                                          "; choose two files, or one result would replace the other");
}

} // namespace skelgen::cli
