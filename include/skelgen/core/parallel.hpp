#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <version>
#ifdef __cpp_lib_jthread
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>
#endif

namespace skelgen::core {
namespace detail {

class WorkerPool;

/// Of the thread that asks; none where it has no others to help it.
inline WorkerPool*& pool_of_this_thread() {
    thread_local WorkerPool* pool = nullptr;
    return pool;
}

#ifdef __cpp_lib_jthread
/// Threads that wait for work and share it with those that bring it: a part of a job may bring another one.
class WorkerPool {
public:
    /// \param helpers threads beside the one that calls `run`.
    explicit WorkerPool(int helpers) {
        for (int i = 0; i < helpers; ++i) threads_.emplace_back([this](const std::stop_token& stop) { help(stop); });
    }
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;
    ~WorkerPool() {
        for (std::jthread& thread : threads_) thread.request_stop();
    }

    [[nodiscard]] int helpers() const { return static_cast<int>(threads_.size()); }

    /// Calls `part` with 0, 1, ... `parts` - 1, each once, on all threads. \throws what the first of the parts that
    /// failed threw, once all others are done.
    void run(std::size_t parts, const std::function<void(std::size_t)>& part) {
        Job job{part, parts, parts, 0, 0, nullptr};
        std::unique_lock lock(mutex_);
        jobs_.push_back(&job);
        changed_.notify_all();
        // As long as others do the last parts, it helps with what they bring, which is less than what they are at.
        Job* next = nullptr;
        while (job.done < job.parts) {
            changed_.wait(lock, [&] { return (next = open_job(&job)) != nullptr || job.done == job.parts; });
            if (next != nullptr) do_part(*next, lock);
        }
        std::erase(jobs_, &job);
        lock.unlock();
        if (job.error) std::rethrow_exception(job.error);
    }

private:
    struct Job {
        const std::function<void(std::size_t)>& part;
        std::size_t parts;
        std::size_t failed; ///< the first part that failed
        std::size_t next, done;
        std::exception_ptr error;
    };

    void help(const std::stop_token& stop) {
        pool_of_this_thread() = this;
        std::unique_lock lock(mutex_);
        Job* job = nullptr;
        while (changed_.wait(lock, stop, [&] { return (job = open_job(nullptr)) != nullptr; })) do_part(*job, lock);
    }

    /// The oldest job that has parts to be done, of those as old as `oldest` and newer ones.
    [[nodiscard]] Job* open_job(const Job* oldest) const {
        const auto first = oldest == nullptr ? jobs_.begin() : std::find(jobs_.begin(), jobs_.end(), oldest);
        const auto found = std::find_if(first, jobs_.end(), [](const Job* job) { return job->next < job->parts; });
        return found == jobs_.end() ? nullptr : *found;
    }

    /// Does a job's next part; `lock` is held before and after.
    void do_part(Job& job, std::unique_lock<std::mutex>& lock) {
        const std::size_t mine = job.next++;
        std::exception_ptr error;
        lock.unlock();
        try {
            job.part(mine);
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        if (error && mine < job.failed) {
            job.failed = mine;
            job.error = error;
        }
        if (++job.done == job.parts) changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::vector<Job*> jobs_;            ///< the oldest first
    std::vector<std::jthread> threads_; ///< the last member: what they use is there before them, and after
};
#else
/// Where the standard library has no such threads, as WebAssembly's has not: the one that calls does all.
class WorkerPool {
public:
    explicit WorkerPool(int) {}
    [[nodiscard]] int helpers() const { return 0; }
    void run(std::size_t parts, const std::function<void(std::size_t)>& part) {
        for (std::size_t p = 0; p < parts; ++p) part(p);
    }
};
#endif

} // namespace detail

/// As long as it lives, loops of the thread that made it are done by so many threads. What comes out does not depend on
/// their number: each entry of a result is made by one of them, and sums are not parted.
class ThreadScope {
public:
    explicit ThreadScope(int threads) {
        const int helpers = std::max(0, threads - 1);
        if (helpers == (before_ == nullptr ? 0 : before_->helpers())) return;
        if (helpers > 0) pool_.emplace(helpers);
        detail::pool_of_this_thread() = pool_ ? &*pool_ : nullptr;
    }
    ThreadScope(const ThreadScope&) = delete;
    ThreadScope& operator=(const ThreadScope&) = delete;
    ~ThreadScope() { detail::pool_of_this_thread() = before_; }

private:
    detail::WorkerPool* before_ = detail::pool_of_this_thread();
    std::optional<detail::WorkerPool> pool_;
};

/// Calls `each` with 0, 1, ... `count` - 1, `grain` in a row, on the threads of the ThreadScope that there is, or on
/// this one; also within another such loop. Calls must not depend on each other. \throws what one of the calls threw.
template <typename Each>
void parallel_for(std::size_t count, std::size_t grain, const Each& each) {
    detail::WorkerPool* const pool = detail::pool_of_this_thread();
    if (pool == nullptr || count <= grain) {
        for (std::size_t i = 0; i < count; ++i) each(i);
        return;
    }
    pool->run((count + grain - 1) / grain, [&](std::size_t p) {
        for (std::size_t i = p * grain; i < std::min(count, (p + 1) * grain); ++i) each(i);
    });
}

/// Calls both, at once where there are threads for that.
template <typename First, typename Second>
void in_parallel(const First& first, const Second& second) {
    parallel_for(2, 1, [&](std::size_t i) { i == 0 ? first() : second(); });
}

} // namespace skelgen::core
