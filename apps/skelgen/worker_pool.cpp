#include "worker_pool.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/posix.hpp>

namespace skelgen::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Job = std::function<std::string(std::size_t)>;

[[noreturn]] void throw_system_error(const char* what) {
    throw Error(ErrorCode::internal,
                std::string("batch: ") + what + ": " + std::generic_category().message(errno) + "; try fewer --jobs");
}

// ------------------------------------------------------------------------------------------- messages over a socket

bool send_all(int socket, const void* data, std::size_t size) {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
        const ::ssize_t sent = ::send(socket, bytes, size, io::detail::no_signal);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return false;
        bytes += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receive_all(int socket, void* data, std::size_t size) {
    char* bytes = static_cast<char*>(data);
    while (size > 0) {
        const ::ssize_t received = ::recv(socket, bytes, size, 0);
        if (received < 0 && errno == EINTR) continue;
        if (received <= 0) return false;
        bytes += received;
        size -= static_cast<std::size_t>(received);
    }
    return true;
}

// ------------------------------------------------------------------------------------------------ the worker's side

/// An exception must end the process here: on its way up it would find the parent's code, and run it twice.
[[noreturn]] void serve(int socket, const Job& job) noexcept {
    std::uint64_t index = 0;
    while (receive_all(socket, &index, sizeof index)) {
        const std::string result = job(static_cast<std::size_t>(index));
        const std::uint64_t size = result.size();
        std::string message(sizeof size, '\0'); // both at once: the parent is woken once
        std::memcpy(message.data(), &size, sizeof size);
        message += result;
        if (!send_all(socket, message.data(), message.size())) break;
    }
    ::_exit(0); // not exit(): what the parent registered and buffered is the parent's
}

/// Keeps a library that prints on standard output from spoiling the parent's.
void silence_standard_output() {
    const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (null >= 0) ::dup2(null, STDOUT_FILENO);
}

void limit_memory(std::size_t bytes) {
    if (bytes == 0) return;
    ::rlimit limit{};
    ::getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = std::min<::rlim_t>(bytes, limit.rlim_max);
    ::setrlimit(RLIMIT_AS, &limit);
}

// ------------------------------------------------------------------------------------------------ the parent's side

std::string describe_end(int wait_status) {
    if (WIFSIGNALED(wait_status)) {
        const int signal = WTERMSIG(wait_status);
        const std::string hint = signal == SIGKILL ? "; perhaps out of memory" : "";
        return "the worker process died of signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")" + hint;
    }
    return "the worker process ended with status " + std::to_string(WEXITSTATUS(wait_status));
}

/// One worker process and the job it is at.
class Worker {
public:
    /// Forks; `others` are the sockets that the child must not keep open.
    Worker(const Job& job, const std::vector<int>& others, std::size_t memory) {
        int ends[2];
        if (!io::detail::make_sockets(ends)) throw_system_error("no socket");
        const ::pid_t parent = ::getpid();
        std::fflush(nullptr); // or the child would print it again
        process_ = ::fork();
        if (process_ < 0) {
            ::close(ends[0]);
            ::close(ends[1]);
            throw_system_error("no worker process");
        }
        if (process_ == 0) {
            io::detail::end_with_parent();
            for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_IGN);
            if (::getppid() != parent) ::_exit(0); // it died before that
            ::close(ends[0]);
            for (const int socket : others) ::close(socket);
            silence_standard_output();
            limit_memory(memory);
            serve(ends[1], job);
        }
        ::close(ends[1]);
        socket_ = ends[0];
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() {
        if (process_ > 0) end();
    }

    [[nodiscard]] int socket() const { return socket_; }
    [[nodiscard]] bool is_busy() const { return job_.has_value(); }
    [[nodiscard]] std::size_t job() const { return job_.value(); }
    [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

    /// Hands over a job; false if the process is no more.
    [[nodiscard]] bool start(std::size_t index) {
        const std::uint64_t message = index;
        if (!send_all(socket_, &message, sizeof message)) return false;
        job_ = index;
        start_ = Clock::now();
        received_.clear();
        return true;
    }

    /// Takes what has arrived; false if the process is no more.
    [[nodiscard]] bool receive() {
        char bytes[4096];
        const ::ssize_t count = ::recv(socket_, bytes, sizeof bytes, MSG_DONTWAIT);
        if (count < 0) return errno == EINTR || errno == EAGAIN;
        received_.append(bytes, static_cast<std::size_t>(count));
        return count > 0;
    }

    /// The job's result once it is all there; the worker is free then.
    [[nodiscard]] std::optional<std::string> take_result() {
        std::uint64_t size = 0;
        if (received_.size() < sizeof size) return std::nullopt;
        std::memcpy(&size, received_.data(), sizeof size);
        if (received_.size() < sizeof size + size) return std::nullopt;
        job_.reset();
        return received_.substr(sizeof size);
    }

    /// Ends the process if it runs and says how it ended.
    std::string end() {
        ::kill(process_, SIGKILL);
        ::close(socket_);
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return describe_end(status);
    }

private:
    ::pid_t process_ = -1;
    int socket_ = -1;
    std::optional<std::size_t> job_;
    Clock::time_point start_;
    std::string received_;
};

/// Turns SIGINT and SIGTERM into something to poll: a pipe that their handler writes to. Workers ignore them: an
/// interrupt from the terminal goes to all processes, and it is the parent that has to end them. One at a time.
class SignalWatch {
public:
    SignalWatch() {
        if (!io::detail::make_pipe(ends_)) throw_system_error("no pipe for signals");
        ::fcntl(ends_[0], F_SETFL, O_NONBLOCK);
        written_to = ends_[1];
        struct ::sigaction action = {};
        action.sa_handler = [](int signal) {
            const int before = errno;
            const auto byte = static_cast<unsigned char>(signal);
            [[maybe_unused]] const ::ssize_t written = ::write(written_to, &byte, 1);
            errno = before;
        };
        action.sa_flags = SA_RESTART;
        ::sigemptyset(&action.sa_mask);
        ::sigaction(SIGINT, &action, &before_[0]);
        ::sigaction(SIGTERM, &action, &before_[1]);
    }
    SignalWatch(const SignalWatch&) = delete;
    SignalWatch& operator=(const SignalWatch&) = delete;
    ~SignalWatch() {
        ::sigaction(SIGINT, &before_[0], nullptr);
        ::sigaction(SIGTERM, &before_[1], nullptr);
        for (const int end : ends_) ::close(end);
    }

    [[nodiscard]] int descriptor() const { return ends_[0]; }

    /// The signal that has come, or 0.
    [[nodiscard]] int take() const {
        unsigned char byte = 0;
        return ::read(ends_[0], &byte, 1) == 1 ? byte : 0;
    }

private:
    static inline int written_to = -1;
    int ends_[2] = {-1, -1};
    struct ::sigaction before_[2] = {};
};

class WorkerPool {
public:
    WorkerPool(std::size_t count, const WorkerPoolOptions& options, const Job& job,
               const std::function<void(std::size_t, const JobOutcome&)>& report)
        : count_(count), timeout_(options.timeout_seconds), memory_(options.memory), job_(job), report_(report),
          workers_(std::min(std::max<std::size_t>(options.workers, 1), count)) {}

    int run() {
        int signal = 0;
        while (signal == 0 && (next_ < count_ || busy() > 0)) {
            feed_idle_workers();
            wait();
            signal = signals_.take();
            if (signal == 0) collect();
        }
        return signal;
    }

private:
    [[nodiscard]] std::ptrdiff_t busy() const {
        return std::count_if(workers_.begin(), workers_.end(), [](const auto& w) { return w && w->is_busy(); });
    }

    void feed_idle_workers() {
        for (auto& worker : workers_)
            if (next_ < count_ && !(worker && worker->is_busy())) feed(worker);
    }

    void feed(std::unique_ptr<Worker>& worker) {
        constexpr int most_tries = 3; // an idle worker may have been killed from outside
        for (int i = 0; i < most_tries; ++i) {
            if (!worker) worker = std::make_unique<Worker>(job_, open_descriptors(), memory_);
            if (worker->start(next_)) {
                ++next_;
                return;
            }
            worker.reset();
        }
        throw Error(ErrorCode::internal, "batch: worker processes die before they are given work; report it");
    }

    [[nodiscard]] std::vector<int> open_descriptors() const {
        std::vector<int> open{signals_.descriptor()};
        for (const auto& worker : workers_)
            if (worker) open.push_back(worker->socket());
        return open;
    }

    /// Until something arrives, or the first job's time is up.
    void wait() const {
        std::vector<::pollfd> descriptors{{signals_.descriptor(), POLLIN, 0}};
        double seconds_left = timeout_;
        for (const auto& worker : workers_) {
            if (!worker || !worker->is_busy()) continue;
            descriptors.push_back({worker->socket(), POLLIN, 0});
            seconds_left = std::min(seconds_left, timeout_ - worker->seconds());
        }
        constexpr double longest_wait = 3600; // poll() takes milliseconds as int; longer timeouts just poll again
        const int milliseconds =
            timeout_ > 0 ? static_cast<int>(std::ceil(std::clamp(seconds_left, 0.0, longest_wait) * 1000)) : -1;
        ::poll(descriptors.data(), descriptors.size(), milliseconds);
    }

    void collect() {
        for (auto& worker : workers_) {
            if (!worker || !worker->is_busy()) continue;
            const bool alive = worker->receive();
            const std::size_t job = worker->job();
            const double seconds = worker->seconds();
            if (const auto result = worker->take_result()) {
                if (next_ < count_) feed(worker); // at work while this process reports
                report_(job, {JobEnd::done, *result, seconds});
            } else if (!alive) {
                report_(job, {JobEnd::crashed, dismiss(worker), seconds});
            } else if (timeout_ > 0 && seconds > timeout_) {
                dismiss(worker);
                report_(job, {JobEnd::timed_out, "took longer than the timeout", seconds});
            }
        }
    }

    std::string dismiss(std::unique_ptr<Worker>& worker) {
        const std::string how = worker->end();
        worker.reset();
        return how;
    }

    std::size_t count_;
    double timeout_;
    std::size_t memory_;
    const Job& job_;
    const std::function<void(std::size_t, const JobOutcome&)>& report_;
    SignalWatch signals_;
    std::vector<std::unique_ptr<Worker>> workers_;
    std::size_t next_ = 0;
};

} // namespace

int run_in_workers(std::size_t count, const WorkerPoolOptions& options, const Job& job,
                   const std::function<void(std::size_t, const JobOutcome&)>& report) {
    return WorkerPool(count, options, job, report).run();
}

} // namespace skelgen::cli
