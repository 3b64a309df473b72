#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace skelgen::cli {

/// How long a command may take before it tells how far it is.
inline constexpr int patience_seconds = 2;

/// What takes away the line that a terminal's cursor is in.
inline constexpr const char* clear_line = "\r\033[K";

/// One line on standard error that is rewritten in place: how much is done, failed, how fast, and how long the rest
/// will take. Does nothing unless standard error is a terminal.
class ProgressBar {
public:
    /// It stays away for the first `after_seconds`.
    ProgressBar(std::size_t total, bool wanted, double after_seconds = 0);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { clear(); }

    void show(std::size_t done, std::size_t failed);

    /// Takes the line away, so that something else can be printed.
    void clear() const;

private:
    std::size_t total_;
    bool is_on_;
    double after_seconds_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The bar's text: "[####------] 12/30, 1 failed, 0.43/s, 0:42 left".
[[nodiscard]] std::string progress_text(std::size_t done, std::size_t failed, std::size_t total, double seconds);

} // namespace skelgen::cli
