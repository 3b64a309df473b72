#include <cerrno>
#include <csignal>
#include <system_error>
#include <vector>

#include <skelgen/io/atomic_file.hpp>

#include "temporary_name.hpp"

namespace skelgen::io {
namespace {

bool is_running(::pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

} // namespace

void remove_leftovers(const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    std::vector<fs::path> leftovers; // first found, then removed: a folder must not change while it is being read
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const ::pid_t process = detail::temporary_name_owner(entry->path().filename().string());
        if (process > 0 && !is_running(process)) leftovers.push_back(entry->path());
    }
    for (const fs::path& file : leftovers) fs::remove(file, error);
}

} // namespace skelgen::io
