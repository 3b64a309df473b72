#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace skelgen::io::detail {

struct ProcessLimits {
    double seconds = 60;                       ///< of the clock
    std::size_t bytes = std::size_t{2} << 30U; ///< that it may take beside what this process has already
};

/// Whether memory can be limited: the address sanitizer takes up terabytes of addresses, of which few are used.
[[nodiscard]] constexpr bool has_memory_limit() {
#if defined(__SANITIZE_ADDRESS__)
    return false;
#elif defined(__has_feature)
    return !__has_feature(address_sanitizer);
#else
    return true;
#endif
}

/// What `work` returns, done in a forked process: a crash or endless loop in a library costs no more than this call,
/// and it cannot change anything here. `what` says in messages what is being done ("reading FBX"). \throws Error what
/// `work` throws; bad_input when it crashes or reaches one of the limits; internal when no process can
///         be started.
[[nodiscard]] std::string run_separately(const std::function<std::string()>& work, const ProcessLimits& limits,
                                         const std::string& what);

} // namespace skelgen::io::detail
