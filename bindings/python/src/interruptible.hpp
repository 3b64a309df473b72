#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

#include <nanobind/nanobind.h>

namespace skelgen::python {

namespace nb = nanobind;

namespace detail {

/// Work that another thread does, and what came of it.
struct AnyTask {
    virtual ~AnyTask() = default;
    std::mutex mutex;
    std::condition_variable changed;
    bool is_done = false;
};

template <typename Work>
struct Task : AnyTask {
    explicit Task(Work wanted) : work(std::move(wanted)) {}

    void operator()() noexcept {
        try {
            result.emplace(work());
        } catch (...) {
            error = std::current_exception();
        }
        const std::lock_guard lock(mutex);
        is_done = true;
        changed.notify_all();
    }

    Work work;
    std::optional<std::invoke_result_t<Work&>> result;
    std::exception_ptr error;
};

/// Whether Python delivers signals to this thread. With the GIL.
[[nodiscard]] bool gets_signals();

/// Keeps what nobody waits for any longer until it is done, and lets go of such that is. With the GIL.
void abandon(std::thread thread, std::unique_ptr<AnyTask> task);
void let_go_of_done();

} // namespace detail

/// To be called at the end of the process: what was abandoned and is not done yet must not see the library's data
/// destroyed, so the process then ends without that. With the GIL.
void leave_abandoned();

/// What `work` returns, done without the GIL. On the thread that gets signals (Ctrl-C), another one does it, and is
/// left alone with it when a signal's handler raises an exception: so `work` owns all that it uses, and holds no
/// reference to the caller's. With the GIL. \throws what `work` throws, or the handler's exception.
template <typename Work>
std::invoke_result_t<Work&> interruptible(Work work) {
    if (!detail::gets_signals()) {
        const nb::gil_scoped_release no_gil;
        return work();
    }
    detail::let_go_of_done();
    constexpr std::chrono::milliseconds between_looks(50);
    auto task = std::make_unique<detail::Task<Work>>(std::move(work));
    std::thread thread([&task = *task] { task(); });
    for (;;) {
        {
            const nb::gil_scoped_release no_gil;
            std::unique_lock lock(task->mutex);
            if (task->changed.wait_for(lock, between_looks, [&] { return task->is_done; })) {
                lock.unlock();
                thread.join();
                break;
            }
        }
        if (PyErr_CheckSignals() != 0) {
            detail::abandon(std::move(thread), std::move(task));
            throw nb::python_error();
        }
    }
    if (task->error) std::rethrow_exception(task->error);
    return *std::move(task->result);
}

} // namespace skelgen::python
