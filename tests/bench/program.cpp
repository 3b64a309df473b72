#include "program.hpp"

#include <chrono>
#include <fcntl.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace skelgen::bench {

ProgramTime run_program(const std::vector<std::string>& arguments) {
    std::vector<std::string> words{SKELGEN_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    ::posix_spawn_file_actions_t silent;
    ::posix_spawn_file_actions_init(&silent);
    ::posix_spawn_file_actions_addopen(&silent, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&silent, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const auto start = std::chrono::steady_clock::now();
    ::pid_t process = 0;
    const int error = ::posix_spawn(&process, argv.front(), &silent, nullptr, argv.data(), ::environ);
    ::posix_spawn_file_actions_destroy(&silent);
    if (error != 0) throw std::runtime_error("cannot run " + words.front());
    int status = 0;
    ::rusage usage{};
    if (::wait4(process, &status, 0, &usage) != process || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw std::runtime_error(words.front() + ' ' + words.back() + " failed");
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    const auto ms = [](const ::timeval& time) {
        return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
    };
    return {ms(usage.ru_utime) + ms(usage.ru_stime), wall.count()};
}

} // namespace skelgen::bench
