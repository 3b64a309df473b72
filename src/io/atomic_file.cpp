#include <skelgen/io/atomic_file.hpp>

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <iterator>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <skelgen/core/error.hpp>

#include "temporary_name.hpp"

namespace skelgen::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_cannot_write(int error) {
    const ErrorCode code = write_error_code(error);
    // Of a file that is to be made, it is the folder that is missing.
    if (error == ENOENT)
        throw Error(code, "cannot be written: its folder does not exist; make it first, or choose another output file");
    throw Error(code, "cannot be written: " + std::generic_category().message(error) +
                          (code == ErrorCode::not_written ? "; make room, or choose another output file"
                                                          : "; choose another output file"));
}

/// Owns a POSIX file descriptor.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (is_open()) ::close(number_);
    }

    [[nodiscard]] bool is_open() const { return number_ >= 0; }

    /// Writes everything; returns 0 or the error's number.
    [[nodiscard]] int write_all(std::string_view content) const {
        while (!content.empty()) {
            const ::ssize_t written = ::write(number_, content.data(), content.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) return errno;
            content.remove_prefix(static_cast<std::size_t>(written));
        }
        return 0;
    }

    /// Gives the file this mode; returns 0 or the error's number.
    [[nodiscard]] int set_mode(::mode_t mode) const { return ::fchmod(number_, mode) == 0 ? 0 : errno; }

    /// Some file systems (quotas, networks) report a failed write only here; returns 0 or the error's number.
    [[nodiscard]] int close() {
        const int result = ::close(number_);
        number_ = -1;
        return result == 0 ? 0 : errno;
    }

private:
    int number_;
};

/// Devices and pipes can be written to but not replaced by a rename. Appending matters when standard output was sent to
/// a regular file: what is in there stays.
void write_directly(const fs::path& path, std::string_view content) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY));
    if (!file.is_open()) throw_cannot_write(errno);
    if (const int error = file.write_all(content)) throw_cannot_write(error);
    if (const int error = file.close()) throw_cannot_write(error);
}

/// Returns 0 or the number of the first error; leaves no file on error.
int write_new_file(const fs::path& path, std::string_view content, const struct ::stat* replaced) {
    constexpr ::mode_t default_mode = 0666; // less the umask, as every other program does
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, default_mode));
    if (!file.is_open()) return errno;
    int error = file.write_all(content);
    if (error == 0 && replaced != nullptr) error = file.set_mode(replaced->st_mode & 0777U);
    const int close_error = file.close();
    if (error == 0) error = close_error;
    if (error != 0) ::unlink(path.c_str());
    return error;
}

/// Writes under a name of its own in the folder of `target`. A run that was killed, in a container whose process ids
/// come round again, may have left the first names behind. Returns 0 or the error's number, and the name.
std::pair<int, fs::path> write_temporary(const fs::path& target, std::string_view content,
                                         const struct ::stat* replaced) {
    constexpr int most_tries = 1000;
    std::pair<int, fs::path> result{EEXIST, {}};
    for (int i = 0; i < most_tries && result.first == EEXIST; ++i) {
        result.second = detail::make_temporary_name(target);
        result.first = write_new_file(result.second, content, replaced);
    }
    return result;
}

/// Whether `path` is one of the links of /proc/<process>/fd, to which /dev/stdout and /dev/fd/<n> lead.
bool is_open_descriptor(const fs::path& path) {
    std::error_code error;
    const fs::path folder = fs::canonical(path.parent_path(), error);
    return !error && folder.filename() == "fd" && *std::next(folder.begin()) == "proc";
}

struct Target {
    fs::path path;
    bool is_descriptor = false; ///< an output of this process, opened by somebody else
};

/// Where `path` leads if it is a symbolic link (even to a file not there yet), so that the rename replaces the file and
/// not the link.
Target resolve_links(const fs::path& path) {
    constexpr int most_links = 40; // as Linux: a longer chain is a loop
    Target target{path};
    std::error_code error;
    for (int i = 0; i < most_links; ++i) {
        if (!fs::is_symlink(fs::symlink_status(target.path, error))) return target;
        if (is_open_descriptor(target.path)) return {target.path, true};
        const fs::path next = fs::read_symlink(target.path, error);
        if (error) throw_cannot_write(error.value());
        target.path = next.is_absolute() ? next : target.path.parent_path() / next;
    }
    throw_cannot_write(ELOOP);
}

} // namespace

ErrorCode write_error_code(int error) {
    switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case EIO:
    case EROFS:
    case EPIPE:
        return ErrorCode::not_written;
    default:
        return ErrorCode::usage;
    }
}

void write_file_atomically(const fs::path& path, std::string_view content) {
    if (path.empty()) throw Error(ErrorCode::usage, "cannot be written: the name of the file is empty; give one");

    struct ::stat existing {};
    const bool exists = ::stat(path.c_str(), &existing) == 0;
    if (exists && S_ISDIR(existing.st_mode)) throw_cannot_write(EISDIR);
    if (exists && !S_ISREG(existing.st_mode)) return write_directly(path, content);
    // A rename would also replace a file that its owner protected against writing.
    if (exists && ::access(path.c_str(), W_OK) != 0) throw_cannot_write(errno);

    const Target target = resolve_links(path);
    if (target.is_descriptor) return write_directly(path, content);
    const auto [write_error, temporary] = write_temporary(target.path, content, exists ? &existing : nullptr);
    if (write_error != 0) throw_cannot_write(write_error);
    if (::rename(temporary.c_str(), target.path.c_str()) != 0) {
        const int error = errno;
        ::unlink(temporary.c_str());
        throw_cannot_write(error);
    }
}

} // namespace skelgen::io
