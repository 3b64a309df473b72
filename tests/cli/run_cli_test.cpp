// Not tests but what they run on: see run_cli.hpp. (Only *_test.cpp files are built.)

#include "run_cli.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace skelgen::test {

namespace fs = std::filesystem;

namespace {

void redirect(const fs::path& file, int descriptor) {
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (opened < 0 || ::dup2(opened, descriptor) < 0) ::_exit(126);
    ::close(opened);
}

} // namespace

CliProcess::CliProcess(const fs::path& folder, const std::vector<std::string>& arguments, const char* program) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);

    process_ = ::fork();
    if (process_ < 0) throw std::runtime_error("no process");
    if (process_ > 0) return;
    redirect(output_ / "out", STDOUT_FILENO);
    redirect(output_ / "err", STDERR_FILENO);
    if (::chdir(folder.c_str()) == 0) ::execv(program, pointers.data());
    ::_exit(127);
}

CliProcess::~CliProcess() {
    if (process_ <= 0) return;
    send(SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

std::vector<::pid_t> CliProcess::children() const {
    const std::string id = std::to_string(process_);
    std::ifstream list("/proc/" + id + "/task/" + id + "/children");
    std::vector<::pid_t> children;
    for (::pid_t child = 0; list >> child;)
        if (is_running(child)) children.push_back(child);
    return children;
}

void CliProcess::send(int signal) const { ::kill(process_, signal); }

CliResult CliProcess::wait() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return {WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status), read_file(output_ / "out"),
            read_file(output_ / "err")};
}

CliResult run_cli(const fs::path& folder, const std::vector<std::string>& arguments) {
    return CliProcess(folder, arguments).wait();
}

CliResult run_shell(const fs::path& folder, const std::string& line) {
    return CliProcess(folder, {"-c", "skelgen='" SKELGEN_CLI "'; " + line}, "/bin/sh").wait();
}

bool is_running(::pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string stat((std::istreambuf_iterator<char>(file)), {});
    const std::size_t name_end = stat.rfind(')'); // the name may hold anything; the state comes after it
    return name_end != std::string::npos && stat.size() > name_end + 2 && stat[name_end + 2] != 'Z' &&
           stat[name_end + 2] != 'X';
}

std::string read_file(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_file(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory()) files.push_back(entry.path().lexically_relative(folder).string());
    std::sort(files.begin(), files.end());
    return files;
}

std::string sphere_off() {
    constexpr int rows = 24, columns = 48;
    std::ostringstream text;
    text << "OFF\n" << (rows - 1) * columns + 2 << " " << (rows - 2) * columns + 2 * columns << " 0\n0 0 1\n";
    for (int i = 1; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double a = std::numbers::pi * i / rows, b = 2 * std::numbers::pi * j / columns;
            text << std::sin(a) * std::cos(b) << " " << std::sin(a) * std::sin(b) << " " << std::cos(a) << "\n";
        }
    text << "0 0 -1\n";
    const auto at = [](int i, int j) { return 1 + (i - 1) * columns + j % columns; };
    for (int j = 0; j < columns; ++j) text << "3 0 " << at(1, j) << " " << at(1, j + 1) << "\n";
    for (int i = 1; i < rows - 1; ++i)
        for (int j = 0; j < columns; ++j)
            text << "4 " << at(i, j) << " " << at(i + 1, j) << " " << at(i + 1, j + 1) << " " << at(i, j + 1) << "\n";
    const int south = (rows - 1) * columns + 1;
    for (int j = 0; j < columns; ++j)
        text << "3 " << south << " " << at(rows - 1, j + 1) << " " << at(rows - 1, j) << "\n";
    return text.str();
}

std::string torus_off() {
    constexpr int rows = 48, columns = 24;
    std::ostringstream text;
    text << "OFF\n" << rows * columns << " " << rows * columns << " 0\n";
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double a = 2 * std::numbers::pi * i / rows, b = 2 * std::numbers::pi * j / columns;
            const double r = 1 + 0.3 * std::cos(b);
            text << r * std::cos(a) << " " << r * std::sin(a) << " " << 0.3 * std::sin(b) << "\n";
        }
    const auto at = [](int i, int j) { return i % rows * columns + j % columns; };
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j)
            text << "4 " << at(i, j) << " " << at(i + 1, j) << " " << at(i + 1, j + 1) << " " << at(i, j + 1) << "\n";
    return text.str();
}

std::string cube_off() {
    return "OFF\n8 6 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"
           "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
}

} // namespace skelgen::test
