#include "progress_bar.hpp"

#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>
#include <unistd.h>

namespace skelgen::cli {
namespace {

/// With two digits: "12/s", "0.25/s".
std::string rate_text(double per_second) {
    std::ostringstream text;
    text << std::setprecision(per_second < 10 ? 2 : 10) << (per_second < 10 ? per_second : std::round(per_second))
         << "/s";
    return text.str();
}

std::string minutes_and_seconds(double seconds) {
    const long whole = std::lround(seconds);
    const std::string rest = std::to_string(whole % 60);
    return std::to_string(whole / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

} // namespace

std::string progress_text(std::size_t done, std::size_t failed, std::size_t total, double seconds) {
    constexpr std::size_t width = 30;
    const std::size_t filled = total == 0 ? width : width * done / total;
    std::string text = "[" + std::string(filled, '#') + std::string(width - filled, '-') + "] " + std::to_string(done) +
                       "/" + std::to_string(total);
    if (failed > 0) text += ", " + std::to_string(failed) + " failed";
    if (done > 0 && done < total) {
        const double each = seconds / static_cast<double>(done);
        if (seconds > 0) text += ", " + rate_text(static_cast<double>(done) / seconds);
        text += ", " + minutes_and_seconds(each * static_cast<double>(total - done)) + " left";
    }
    return text;
}

ProgressBar::ProgressBar(std::size_t total, bool wanted, double after_seconds)
    : total_(total), is_on_(wanted && ::isatty(STDERR_FILENO) == 1), after_seconds_(after_seconds) {}

void ProgressBar::show(std::size_t done, std::size_t failed) {
    if (!is_on_) return;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    if (passed.count() < after_seconds_) return;
    std::fprintf(stderr, "%s%s", clear_line, progress_text(done, failed, total_, passed.count()).c_str());
    std::fflush(stderr);
}

void ProgressBar::clear() const {
    if (is_on_) std::fputs(clear_line, stderr);
}

} // namespace skelgen::cli
