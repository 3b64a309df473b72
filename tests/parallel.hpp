#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace skelgen::test {

/// Calls work(0), ..., work(count - 1) in `jobs` threads. The first exception stops the rest and comes out here.
template <typename Work>
void for_each_index(std::size_t count, unsigned jobs, const Work& work) {
    std::atomic<std::size_t> next = 0;
    std::exception_ptr failure;
    std::mutex failing;
    {
        std::vector<std::jthread> threads;
        for (unsigned t = 0; t < jobs; ++t)
            threads.emplace_back([&] {
                for (std::size_t i = next++; i < count; i = next++) try {
                        work(i);
                    } catch (...) {
                        const std::lock_guard lock(failing);
                        if (!failure) failure = std::current_exception();
                        next = count;
                    }
            });
    }
    if (failure) std::rethrow_exception(failure);
}

} // namespace skelgen::test
