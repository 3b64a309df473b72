#include "temporary_name.hpp"

#include <atomic>
#include <charconv>
#include <string_view>
#include <system_error>
#include <unistd.h>

// ".skelgen-<process>-<number>.tmp"

namespace skelgen::io::detail {
namespace {

constexpr std::string_view prefix = ".skelgen-", suffix = ".tmp";

} // namespace

std::filesystem::path make_temporary_name(const std::filesystem::path& target) {
    static std::atomic<unsigned> calls{0};
    std::string name(prefix);
    name += std::to_string(::getpid()) + "-" + std::to_string(calls++);
    name += suffix;
    // A fixed, short stem: a suffix to the target's own name could exceed the longest name the file system takes.
    return std::filesystem::path(target).replace_filename(name);
}

::pid_t temporary_name_owner(const std::string& name) {
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) return 0;
    ::pid_t process = 0;
    const char* const end = name.data() + name.size();
    const auto result = std::from_chars(name.data() + prefix.size(), end, process);
    return result.ec == std::errc() && result.ptr != end && *result.ptr == '-' ? process : 0;
}

} // namespace skelgen::io::detail
