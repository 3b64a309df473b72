#include <skelgen/core/parallel.hpp>

#include <atomic>
#include <numeric>
#include <set>
#include <stdexcept>
#include <vector>

#include "catch.hpp"

using namespace skelgen::core;

TEST_CASE("a loop is done once for each number, by however many threads", "[core]") {
    for (const int threads : {1, 2, 3, 8}) {
        const ThreadScope scope(threads);
        for (const std::size_t count : {0U, 1U, 7U, 1000U}) {
            std::vector<int> times(count, 0);
            parallel_for(count, 3, [&](std::size_t i) { ++times[i]; });
            CHECK(times == std::vector<int>(count, 1));
        }
    }
}

TEST_CASE("parts wait for each other where they are done at once", "[core]") {
    const ThreadScope scope(2);
    std::atomic<int> arrived = 0;
    std::set<std::thread::id> threads;
    std::mutex mutex;
    const auto meet = [&] {
        ++arrived;
        while (arrived < 2) std::this_thread::yield(); // for ever, if one came after the other
        const std::lock_guard lock(mutex);
        threads.insert(std::this_thread::get_id());
    };
    in_parallel(meet, meet);
    CHECK(threads.size() == 2);
}

TEST_CASE("a loop within a loop is done once for each number", "[core]") {
    for (const int threads : {1, 2, 5}) {
        const ThreadScope scope(threads);
        std::vector<std::vector<int>> table(20, std::vector<int>(50, 0));
        parallel_for(table.size(), 1, [&](std::size_t row) {
            parallel_for(table[row].size(), 1, [&](std::size_t i) { ++table[row][i]; });
        });
        CHECK(table == std::vector<std::vector<int>>(20, std::vector<int>(50, 1)));
    }
}

TEST_CASE("a thread that has nothing to do helps with a loop within what another one does", "[core]") {
    const ThreadScope scope(2);
    std::atomic<int> arrived = 0;
    const auto meet = [&] {
        ++arrived;
        while (arrived < 2) std::this_thread::yield(); // for ever, if one came after the other
    };
    in_parallel([] {}, [&] { in_parallel(meet, meet); });
    arrived = 0;
    in_parallel([&] { in_parallel(meet, meet); }, [] {});
    CHECK(arrived == 2);
}

TEST_CASE("what a part throws comes out once the others are done, and the next loop is done", "[core]") {
    for (const int threads : {1, 3}) {
        const ThreadScope scope(threads);
        std::atomic<int> done = 0;
        const auto fail_at_ten = [&](std::size_t i) {
            if (i == 10) throw std::runtime_error("ten");
            ++done;
        };
        CHECK_THROWS_WITH(parallel_for(40, 1, fail_at_ten), "ten");
        if (threads > 1) CHECK(done == 39);
        const auto fail_within = [&](std::size_t row) {
            parallel_for(8, 1, [&](std::size_t i) { fail_at_ten(8 * row + i); });
        };
        CHECK_THROWS_WITH(parallel_for(4, 1, fail_within), "ten");
        std::vector<int> next(30, 0);
        parallel_for(next.size(), 1, [&](std::size_t i) { next[i] = 1; });
        CHECK(std::accumulate(next.begin(), next.end(), 0) == 30);
    }
}

TEST_CASE("scopes within scopes end where they began", "[core]") {
    const ThreadScope outer(2);
    {
        const ThreadScope inner(1);
        const auto here = std::this_thread::get_id();
        parallel_for(10, 1, [&](std::size_t) { CHECK(std::this_thread::get_id() == here); });
    }
    std::vector<int> times(100, 0);
    parallel_for(times.size(), 1, [&](std::size_t i) { ++times[i]; });
    CHECK(times == std::vector<int>(100, 1));
}
