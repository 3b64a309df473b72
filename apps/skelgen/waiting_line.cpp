#include "waiting_line.hpp"

#include <chrono>
#include <unistd.h>
#include <utility>

#include "progress_bar.hpp"

namespace skelgen::cli {
namespace {

/// Past the buffers of C, whose locks a process that is forked meanwhile would find held.
void write_to_terminal(const std::string& text) {
    [[maybe_unused]] const ::ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

} // namespace

WaitingLine::WaitingLine(std::string what, bool wanted) : what_(std::move(what)) {
    if (!wanted || ::isatty(STDERR_FILENO) != 1) return;
    clock_ = std::thread([this] {
        const auto start = std::chrono::steady_clock::now();
        auto next = std::chrono::seconds(patience_seconds);
        std::unique_lock lock(mutex_);
        while (!changed_.wait_until(lock, start + next, [this] { return is_over_; })) {
            write_to_terminal(clear_line + what_ + ": " + std::to_string(next.count()) + " s");
            next += std::chrono::seconds(1);
        }
        if (next.count() > patience_seconds) write_to_terminal(clear_line);
    });
}

void WaitingLine::end() {
    if (!clock_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
    }
    changed_.notify_one();
    clock_.join();
}

} // namespace skelgen::cli
