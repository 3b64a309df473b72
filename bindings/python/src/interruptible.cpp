#include "interruptible.hpp"

#include <cstdio>
#include <cstdlib>
#include <vector>

#include <unistd.h>

namespace skelgen::python {
namespace {

struct Abandoned {
    std::thread thread;
    std::unique_ptr<detail::AnyTask> task;
    pid_t process; ///< a forked one has no such thread
};

/// Never destroyed: threads may still be at it when the process ends, and a forked process can neither wait for threads
/// of its parent nor let go of them.
std::vector<Abandoned>& all_abandoned() {
    static auto* const list = new std::vector<Abandoned>;
    return *list;
}

bool is_done(const Abandoned& abandoned) {
    if (abandoned.process != ::getpid()) return false;
    const std::lock_guard lock(abandoned.task->mutex);
    return abandoned.task->is_done;
}

} // namespace

namespace detail {

bool gets_signals() {
    const nb::module_ threading = nb::module_::import_("threading");
    return threading.attr("get_ident")().equal(threading.attr("main_thread")().attr("ident"));
}

void abandon(std::thread thread, std::unique_ptr<AnyTask> task) {
    all_abandoned().push_back({std::move(thread), std::move(task), ::getpid()});
}

void let_go_of_done() {
    std::erase_if(all_abandoned(), [](Abandoned& abandoned) {
        if (!is_done(abandoned)) return false;
        abandoned.thread.join();
        return true;
    });
}

} // namespace detail

void leave_abandoned() {
    detail::let_go_of_done();
    if (all_abandoned().empty()) return;
#ifdef __GLIBC__
    ::on_exit(
        [](int status, void*) {
            std::fflush(nullptr);
            ::_exit(status);
        },
        nullptr);
#else
    for (Abandoned& abandoned : all_abandoned()) {
        if (abandoned.process != ::getpid()) continue;
        const nb::gil_scoped_release no_gil;
        std::unique_lock lock(abandoned.task->mutex);
        abandoned.task->changed.wait(lock, [&] { return abandoned.task->is_done; });
    }
#endif
}

} // namespace skelgen::python
