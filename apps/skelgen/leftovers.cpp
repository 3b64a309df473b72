#include "leftovers.hpp"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <system_error>
#include <vector>

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

/// The process that made a temporary file, by its name ".skelgen-<process>-<number>.tmp"; 0 if it is none.
::pid_t owner(const std::string& name) {
    const std::string prefix = ".skelgen-";
    if (name.rfind(prefix, 0) != 0 || !name.ends_with(".tmp")) return 0;
    ::pid_t process = 0;
    const char* const end = name.data() + name.size();
    const auto result = std::from_chars(name.data() + prefix.size(), end, process);
    return result.ec == std::errc() && result.ptr != end && *result.ptr == '-' ? process : 0;
}

bool is_running(::pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

} // namespace

void remove_leftovers(const fs::path& folder) {
    std::vector<fs::path> leftovers; // first found, then removed: a folder must not change while it is being read
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const ::pid_t process = owner(entry->path().filename().string());
        if (process > 0 && !is_running(process)) leftovers.push_back(entry->path());
    }
    for (const fs::path& file : leftovers) fs::remove(file, error);
}

} // namespace skelgen::cli
