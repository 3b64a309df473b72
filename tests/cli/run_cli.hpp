#pragma once

// Runs the program as a user would, and makes the files to run it on.

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

#include "temporary_folder.hpp"

namespace skelgen::test {

/// A man in mid-stride.
inline const std::string sample_body = SKELGEN_DATA "/sample/body.off";

/// What a run of the program left behind.
struct CliResult {
    int status = -1; ///< the exit status, or -signal if a signal ended it
    std::string out;
    std::string err;
};

/// A running skelgen. Ends it, if need be, when it goes out of scope.
class CliProcess {
public:
    /// Starts `skelgen arguments...` in `folder`, or another program.
    CliProcess(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
               const char* program = SKELGEN_CLI);
    CliProcess(const CliProcess&) = delete;
    CliProcess& operator=(const CliProcess&) = delete;
    ~CliProcess();

    [[nodiscard]] ::pid_t id() const { return process_; }
    /// The processes it has started that still run.
    [[nodiscard]] std::vector<::pid_t> children() const;
    void send(int signal) const;
    /// Waits for its end.
    CliResult wait();

private:
    ::pid_t process_ = -1;
    TemporaryFolder output_;
};

[[nodiscard]] CliResult run_cli(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// Runs a line of shell in which $skelgen is the program.
[[nodiscard]] CliResult run_shell(const std::filesystem::path& folder, const std::string& line);

/// Whether the process runs: a dead one that nobody has waited for does not.
[[nodiscard]] bool is_running(::pid_t process);

/// Calls `condition` until it is true; false if that takes longer than 30 s.
template <typename Condition>
[[nodiscard]] bool wait_until(const Condition& condition);

[[nodiscard]] std::string read_file(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, const std::string& text);

/// All files below `folder`, relative to it, in order.
[[nodiscard]] std::vector<std::string> files_below(const std::filesystem::path& folder);

[[nodiscard]] std::string sphere_off();
[[nodiscard]] std::string torus_off();
[[nodiscard]] std::string cube_off();

} // namespace skelgen::test

// ------------------------------------------------------------------------------------------------------ templates

#include <chrono>
#include <thread>

namespace skelgen::test {

template <typename Condition>
bool wait_until(const Condition& condition) {
    for (int i = 0; i < 3000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

} // namespace skelgen::test
