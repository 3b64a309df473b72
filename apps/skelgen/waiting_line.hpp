#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace skelgen::cli {

/// Tells on standard error that something goes on, and for how long: one line that is rewritten in place, beginning
/// after 2 s. For work of which nobody knows how much is left; nothing else may be printed meanwhile. Does nothing
/// unless standard error is a terminal.
class WaitingLine {
public:
    WaitingLine(std::string what, bool wanted);
    WaitingLine(const WaitingLine&) = delete;
    WaitingLine& operator=(const WaitingLine&) = delete;
    ~WaitingLine() { end(); }

    /// Takes the line away for good.
    void end();

private:
    std::string what_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool is_over_ = false;
    std::thread clock_;
};

} // namespace skelgen::cli
