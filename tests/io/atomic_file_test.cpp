#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>

#include "catch.hpp"
#include "temporary_folder.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
namespace fs = std::filesystem;

namespace {

std::string content_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

std::size_t files_in(const TemporaryFolder& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

void check_refused(const fs::path& path, ErrorCode code = ErrorCode::usage, const std::string& content = "new") {
    INFO(path);
    try {
        write_file_atomically(path, content);
        FAIL_CHECK("nothing was thrown");
    } catch (const Error& error) {
        CHECK(error.code() == code);
        CHECK_THAT(error.what(), Catch::Matchers::StartsWith("cannot be written: "));
    }
}

} // namespace

TEST_CASE("write_file_atomically: makes and replaces files", "[io][atomic]") {
    const TemporaryFolder folder;
    write_file_atomically(folder / "a.json", std::string_view("a\0b", 3));
    CHECK(content_of(folder / "a.json") == std::string("a\0b", 3));
    write_file_atomically(folder / "a.json", "");
    CHECK(fs::file_size(folder / "a.json") == 0);
    write_file_atomically(folder / std::string(255, 'n'), "long name");
    CHECK(content_of(folder / std::string(255, 'n')) == "long name");
    CHECK(files_in(folder) == 2);
}

TEST_CASE("write_file_atomically: a bare name goes to the working folder", "[io][atomic]") {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    write_file_atomically("bare", "text");
    fs::current_path(before);
    CHECK(content_of(folder / "bare") == "text");
}

TEST_CASE("write_file_atomically: new files follow the umask, replaced ones keep their permissions", "[io][atomic]") {
    const TemporaryFolder folder;
    const ::mode_t mask = ::umask(027);
    write_file_atomically(folder / "new", "1");
    ::umask(mask);
    CHECK(fs::status(folder / "new").permissions() == static_cast<fs::perms>(0640));
    fs::permissions(folder / "new", static_cast<fs::perms>(0604));
    write_file_atomically(folder / "new", "2");
    CHECK(fs::status(folder / "new").permissions() == static_cast<fs::perms>(0604));
}

TEST_CASE("write_file_atomically: a symbolic link stays one", "[io][atomic]") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "real");
    fs::create_symlink("real/target", folder / "link"); // to nothing as yet
    write_file_atomically(folder / "link", "1");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(content_of(folder / "real/target") == "1");
    write_file_atomically(folder / "link", "2");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(content_of(folder / "real/target") == "2");
    fs::create_symlink("loop", folder / "loop");
    check_refused(folder / "loop");
}

TEST_CASE("write_file_atomically: devices and pipes are written to", "[io][atomic]") {
    const TemporaryFolder folder;
    write_file_atomically("/dev/null", "gone");
    CHECK(fs::is_character_file("/dev/null"));

    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    const std::string large(1 << 20, 'x'); // more than a pipe holds at a time
    std::string received;
    std::thread reader([&] { received = content_of(folder / "pipe"); });
    write_file_atomically(folder / "pipe", large);
    reader.join();
    CHECK(received == large);
    CHECK(fs::is_fifo(folder / "pipe"));
}

TEST_CASE("write_file_atomically: an output that somebody else opened is added to", "[io][atomic]") {
    const TemporaryFolder folder;
    std::FILE* file = std::fopen((folder / "log").c_str(), "w");
    REQUIRE(file != nullptr);
    std::fputs("before ", file);
    std::fflush(file);
    write_file_atomically("/dev/fd/" + std::to_string(::fileno(file)), "after");
    std::fclose(file);
    CHECK(content_of(folder / "log") == "before after");
    CHECK(files_in(folder) == 1);
}

TEST_CASE("write_file_atomically: what cannot be written leaves nothing behind", "[io][atomic]") {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "old");
    fs::create_directory(folder / "folder");
    check_refused("");
    check_refused(folder / "folder");
    check_refused(folder / "missing/file");
    check_refused(folder / "file/below");
    check_refused(folder / std::string(300, 'n'));
    check_refused("/dev/full", ErrorCode::not_written);
    CHECK(content_of(folder / "file") == "old");
    CHECK(files_in(folder) == 2);
}

TEST_CASE("write_error_code: no room is one thing, the wrong place another", "[io][atomic]") {
    for (const int error : {ENOSPC, EDQUOT, EFBIG, EIO, EROFS, EPIPE})
        CHECK(write_error_code(error) == ErrorCode::not_written);
    for (const int error : {ENOENT, EACCES, EPERM, EISDIR, ENOTDIR, ELOOP, ENAMETOOLONG})
        CHECK(write_error_code(error) == ErrorCode::usage);
}

TEST_CASE("write_file_atomically: a file that may not grow that large leaves nothing behind", "[io][atomic]") {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "old");
    struct ::rlimit before {};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    struct ::rlimit small = before;
    small.rlim_cur = 1000;
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN); // else it ends the process
    check_refused(folder / "file", ErrorCode::not_written, std::string(5000, 'x'));
    std::signal(SIGXFSZ, handler);
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
    CHECK(content_of(folder / "file") == "old");
    CHECK(files_in(folder) == 1);
}

TEST_CASE("write_file_atomically: a protected file or folder is refused", "[io][atomic]") {
    if (::geteuid() == 0) SKELGEN_SKIP("root may write everywhere");
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "old");
    fs::permissions(folder / "file", fs::perms::owner_read);
    check_refused(folder / "file");
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    check_refused(folder / "new");
    fs::permissions(folder.path(), fs::perms::owner_all);
    CHECK(content_of(folder / "file") == "old");
    CHECK(files_in(folder) == 1);
}

TEST_CASE("write_file_atomically: names that a killed run left behind are stepped over", "[io][atomic]") {
    const TemporaryFolder folder;
    for (int i = 0; i < 200; ++i)
        std::ofstream(folder / (".skelgen-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp"))
            << "stale";
    write_file_atomically(folder / "file", "new");
    CHECK(content_of(folder / "file") == "new");
    CHECK(files_in(folder) == 201);
}

TEST_CASE("write_file_atomically: threads writing one file leave one of their contents", "[io][atomic]") {
    const TemporaryFolder folder;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&folder, t] {
            for (int i = 0; i < 20; ++i)
                write_file_atomically(folder / "file", std::string(10000, static_cast<char>('a' + t)));
        });
    for (std::thread& thread : threads) thread.join();
    const std::string content = content_of(folder / "file");
    CHECK(content == std::string(10000, content[0]));
    CHECK(files_in(folder) == 1);
}
