#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace skelgen::core {
namespace detail {

/// Threads that wait for work and share it with the one that brings it.
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

    /// Calls `part` with 0, 1, ... `parts` - 1, each once, on all threads. \throws what the first of the parts that
    /// failed threw, once all others are done.
    void run(std::size_t parts, const std::function<void(std::size_t)>& part) {
        std::unique_lock lock(mutex_);
        part_ = &part;
        parts_ = parts;
        next_ = done_ = 0;
        failed_ = parts;
        error_ = nullptr;
        changed_.notify_all();
        work(lock);
        changed_.wait(lock, [this] { return done_ == parts_; });
        part_ = nullptr;
        if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    }

private:
    void help(const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        while (changed_.wait(lock, stop, [this] { return part_ != nullptr && next_ < parts_; })) work(lock);
    }

    /// Does parts as long as there are any; `lock` is held before and after.
    void work(std::unique_lock<std::mutex>& lock) {
        while (part_ != nullptr && next_ < parts_) {
            const std::size_t mine = next_++;
            const std::function<void(std::size_t)>& part = *part_;
            std::exception_ptr error;
            lock.unlock();
            try {
                part(mine);
            } catch (...) {
                error = std::current_exception();
            }
            lock.lock();
            if (error && mine < failed_) {
                failed_ = mine;
                error_ = error;
            }
            if (++done_ == parts_) changed_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable_any changed_;
    const std::function<void(std::size_t)>* part_ = nullptr;
    std::size_t parts_ = 0, next_ = 0, done_ = 0, failed_ = 0;
    std::exception_ptr error_;
    std::vector<std::jthread> threads_; ///< the last member: what they use is there before them, and after
};

/// Of the thread that asks; none where it has no others to help it.
inline WorkerPool*& pool_of_this_thread() {
    thread_local WorkerPool* pool = nullptr;
    return pool;
}

} // namespace detail

/// As long as it lives, loops of the thread that made it are done by so many threads. What comes out does not depend on
/// their number: each entry of a result is made by one of them, and sums are not parted.
class ThreadScope {
public:
    explicit ThreadScope(int threads) : pool_(std::max(0, threads - 1)) {
        detail::pool_of_this_thread() = threads > 1 ? &pool_ : nullptr;
    }
    ThreadScope(const ThreadScope&) = delete;
    ThreadScope& operator=(const ThreadScope&) = delete;
    ~ThreadScope() { detail::pool_of_this_thread() = before_; }

private:
    detail::WorkerPool* before_ = detail::pool_of_this_thread();
    detail::WorkerPool pool_;
};

/// Calls `each` with 0, 1, ... `count` - 1, `grain` in a row, on the threads of the ThreadScope that there is, or on
/// this one. Calls must not depend on each other. \throws what one of the calls threw.
template <typename Each>
void parallel_for(std::size_t count, std::size_t grain, const Each& each) {
    detail::WorkerPool*& pool = detail::pool_of_this_thread();
    if (pool == nullptr || count <= grain) {
        for (std::size_t i = 0; i < count; ++i) each(i);
        return;
    }
    // Loops within this one, in any of the threads, are done by the thread that meets them.
    detail::WorkerPool& helpers = *std::exchange(pool, nullptr);
    const std::function<void(std::size_t)> part = [&](std::size_t p) {
        for (std::size_t i = p * grain; i < std::min(count, (p + 1) * grain); ++i) each(i);
    };
    try {
        helpers.run((count + grain - 1) / grain, part);
    } catch (...) {
        pool = &helpers;
        throw;
    }
    pool = &helpers;
}

/// Calls both, at once where there are threads for that.
template <typename First, typename Second>
void in_parallel(const First& first, const Second& second) {
    parallel_for(2, 1, [&](std::size_t i) { i == 0 ? first() : second(); });
}

} // namespace skelgen::core
