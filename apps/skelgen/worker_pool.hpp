#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace skelgen::cli {

struct WorkerPoolOptions {
    std::size_t workers = 1;    ///< processes at a time
    double timeout_seconds = 0; ///< a job that takes longer is ended; 0: never
    std::size_t memory = 0;     ///< bytes of address space of each worker; allocations beyond it fail; 0: no limit
};

enum class JobEnd { done, crashed, timed_out };

/// How one job ended.
struct JobOutcome {
    JobEnd end = JobEnd::done;
    std::string result; ///< what the job returned; if it did not, one sentence saying why
    double seconds = 0;
};

/// Runs job(0), ..., job(count - 1) in worker processes, and report(i, outcome) in this one as each ends. A job that
/// crashes or hangs costs itself alone: its worker is replaced. Workers are forked once and fed one job after the
/// other; call this before any thread is started. They die with this process, however it dies.
///
/// SIGINT and SIGTERM end the run: workers are killed, the jobs they were at are not reported. Returns that signal's
/// number, or 0 when all jobs have been run. \throws Error internal when no worker can be started; what `report`
/// throws.
[[nodiscard]] int run_in_workers(std::size_t count, const WorkerPoolOptions& options,
                                 const std::function<std::string(std::size_t)>& job,
                                 const std::function<void(std::size_t, const JobOutcome&)>& report);

} // namespace skelgen::cli
