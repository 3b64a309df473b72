#include "separate_process.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <poll.h>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <skelgen/core/error.hpp>
#include <skelgen/io/posix.hpp>

namespace skelgen::io::detail {
namespace {

// The first byte of what the process sends: whether its result follows, or an error's code and text.
constexpr char result_mark = 'r', error_mark = 'e';

// -------------------------------------------------------------------------------------------- in the other process

std::size_t address_space_in_use() {
    std::ifstream file("/proc/self/statm");
    std::size_t pages = 0;
    file >> pages;
    return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void set_limit(decltype(RLIMIT_AS) resource, std::size_t value) {
    const ::rlimit limit{static_cast<::rlim_t>(value), static_cast<::rlim_t>(value)};
    ::setrlimit(resource, &limit); // where it cannot be set there is a stricter one
}

void set_limits(const ProcessLimits& limits) {
    end_with_parent();
    set_limit(RLIMIT_CORE, 0);
    set_limit(RLIMIT_CPU, static_cast<std::size_t>(std::ceil(limits.seconds)) + 1);
    if (has_memory_limit()) set_limit(RLIMIT_AS, address_space_in_use() + limits.bytes);
    const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC); // what a library prints would spoil the output
    if (null < 0) return;
    ::dup2(null, STDOUT_FILENO);
    ::dup2(null, STDERR_FILENO);
}

void send(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ::ssize_t sent = ::write(descriptor, bytes.data(), bytes.size());
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
}

std::string error_message(ErrorCode code, const char* text) {
    return std::string{error_mark, static_cast<char>(code)} + text;
}

/// An exception must end here: on its way up it would find the code of the process that was forked.
std::string do_work(const std::function<std::string()>& work) noexcept {
    try {
        return result_mark + work();
    } catch (const Error& error) {
        return error_message(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return error_message(ErrorCode::bad_input,
                             "needs more memory than a file of this size should; export it as GLB");
    } catch (const std::exception& error) {
        return error_message(ErrorCode::bad_input, error.what());
    }
}

// ------------------------------------------------------------------------------------------------- in this process

using Clock = std::chrono::steady_clock;

/// The other process and the pipe from it. Ends it, if need be, when it goes out of scope.
class Process {
public:
    Process(const std::function<std::string()>& work, const ProcessLimits& limits) {
        int ends[2];
        if (!make_pipe(ends)) throw_system_error("no pipe");
        std::fflush(nullptr); // or the other process would print it again
        process_ = ::fork();
        if (process_ < 0) {
            ::close(ends[0]);
            ::close(ends[1]);
            throw_system_error("no process");
        }
        if (process_ == 0) {
            set_limits(limits);
            send(ends[1], do_work(work));
            ::_exit(0); // not exit(): what was registered and buffered is not this process's
        }
        ::close(ends[1]);
        pipe_ = ends[0];
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process() {
        ::close(pipe_);
        if (process_ > 0) end();
    }

    /// All that it sends until it ends; false in `in_time` where it takes longer than `seconds`.
    [[nodiscard]] std::string receive(double seconds, bool& in_time) const {
        const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
        std::string received;
        for (;;) {
            const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
            in_time = left > 0;
            if (!in_time) return received;
            ::pollfd descriptor{pipe_, POLLIN, 0};
            if (::poll(&descriptor, 1, static_cast<int>(std::ceil(std::min(left, 3600.0) * 1000))) <= 0) continue;
            char bytes[1 << 16];
            const ::ssize_t count = ::read(pipe_, bytes, sizeof bytes);
            if (count == 0) return received;
            if (count > 0) received.append(bytes, static_cast<std::size_t>(count));
        }
    }

    /// Ends the process if it still runs; the status that waitpid() gives.
    int end() {
        ::kill(process_, SIGKILL);
        return wait();
    }

    int wait() {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return status;
    }

private:
    [[noreturn]] static void throw_system_error(const char* what) {
        throw Error(ErrorCode::internal, std::string(what) + " can be had for a reader: " +
                                             std::generic_category().message(errno) + "; close other programs");
    }

    ::pid_t process_ = -1;
    int pipe_ = -1;
};

} // namespace

std::string run_separately(const std::function<std::string()>& work, const ProcessLimits& limits,
                           const std::string& what) {
    Process process(work, limits);
    bool in_time = true;
    std::string received = process.receive(limits.seconds, in_time);
    const int status = in_time ? process.wait() : process.end();
    if (!in_time || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        throw Error(ErrorCode::bad_input, what + " took too long; export it as GLB");
    if (WIFSIGNALED(status))
        throw Error(ErrorCode::bad_input, what + " crashed (" + ::strsignal(WTERMSIG(status)) +
                                              "): it is probably damaged; export it again, or as GLB");
    if (received.starts_with(error_mark) && received.size() >= 2)
        throw Error(static_cast<ErrorCode>(received[1]), received.substr(2));
    if (!received.starts_with(result_mark)) throw Error(ErrorCode::bad_input, what + " ended early; export it as GLB");
    return received.substr(1);
}

} // namespace skelgen::io::detail
