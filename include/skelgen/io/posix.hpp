#pragma once

#include <csignal>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

/// What POSIX leaves to its systems.
namespace skelgen::io::detail {

/// Has a descriptor closed in programs that this one starts.
inline void close_on_exec(int descriptor) { ::fcntl(descriptor, F_SETFD, FD_CLOEXEC); }

/// A pipe, or a pair of sockets, that programs started from here do not get. \returns whether there is one.
[[nodiscard]] inline bool make_pipe(int (&ends)[2]) {
    if (::pipe(ends) != 0) return false;
    for (const int end : ends) close_on_exec(end);
    return true;
}
[[nodiscard]] inline bool make_sockets(int (&ends)[2]) {
    if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return false;
    for (const int end : ends) close_on_exec(end);
    return true;
}

/// Has this process end when its parent does, where the system can. Elsewhere a worker notices by its socket, and other
/// processes by their limits.
inline void end_with_parent() {
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

#ifdef MSG_NOSIGNAL
inline constexpr int no_signal = MSG_NOSIGNAL;
#else
inline constexpr int no_signal = 0; // programs ignore SIGPIPE
#endif

} // namespace skelgen::io::detail
