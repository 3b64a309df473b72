#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include <skelgen/core/error.hpp>

#include "catch.hpp"
#include "io/separate_process.hpp"

using namespace skelgen;
using skelgen::io::detail::run_separately;

namespace {

/// What comes of work that is not well behaved: the error's text, which is about the input.
template <typename Work>
std::string error_of(const Work& work, double seconds = 20) {
    try {
        static_cast<void>(run_separately(work, {seconds, std::size_t{256} << 20U}, "the work"));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("separate process: results and errors come back, changes do not", "[codecs][process]") {
    std::string large(3000000, 'x');
    large[12345] = '\0';
    int changed = 0;
    const std::string result = run_separately(
        [&] {
            changed = 1;
            return large;
        },
        {}, "the work");
    CHECK((result == large));
    CHECK(changed == 0);
    CHECK(run_separately([] { return std::string(); }, {}, "the work").empty());
    try {
        static_cast<void>(run_separately([]() -> std::string { throw Error(ErrorCode::usage, "mind this"); }, {}, "x"));
        FAIL_CHECK("no error");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        CHECK(std::string(error.what()) == "mind this");
    }
}

TEST_CASE("separate process: crashes, hangs and hunger end it alone", "[codecs][process]") {
    CHECK_THAT(error_of([]() -> std::string {
                   std::raise(SIGKILL);
                   return "";
               }),
               Catch::Matchers::Contains("the work crashed"));
    CHECK_THAT(error_of([]() -> std::string { std::_Exit(0); }), Catch::Matchers::Contains("ended early"));
    const auto start = std::chrono::steady_clock::now();
    CHECK_THAT(error_of(
                   []() -> std::string {
                       for (;;) std::this_thread::yield();
                   },
                   0.2),
               Catch::Matchers::Contains("too long"));
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
    if (!io::detail::has_memory_limit()) return;
    CHECK_THAT(error_of([]() -> std::string {
                   std::vector<std::string> blocks;
                   while (blocks.size() < 64) blocks.emplace_back(std::size_t{1} << 24U, 'x');
                   return "";
               }),
               Catch::Matchers::Contains("memory"));
}
