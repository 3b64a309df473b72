#include "batch_summary.hpp"

#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <fstream>
#include <istream>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>

#include "console.hpp"

namespace skelgen::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Keeps other processes out of a folder's summary as long as it lives. The folder itself is what is locked: the
/// summary is replaced now and then, and a lock file would have to be cleaned up. Where a file system knows no locks,
/// there are none.
class FolderLock {
public:
    explicit FolderLock(const std::filesystem::path& folder)
        : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
        }
    }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    ~FolderLock() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

private:
    int descriptor_;
};

SummaryContent parse_lines(std::istream& stream) {
    SummaryContent content;
    for (std::string text; std::getline(stream, text);) {
        const bool is_cut_off = stream.eof(); // it has no line end
        try {
            if (is_cut_off)
                ++content.unreadable;
            else
                content.lines.push_back(parse_summary_line(text));
        } catch (const Error&) { // cut off, and a later line put behind it
            ++content.unreadable;
        }
    }
    return content;
}

/// Empty where there is no such file.
SummaryLines read_lines(const std::filesystem::path& file) {
    SummaryLines lines;
    std::ifstream stream(file, std::ios::binary);
    for (SummaryLine& line : parse_lines(stream).lines) {
        std::string name = line.file;
        lines[std::move(name)] = std::move(line);
    }
    return lines;
}

std::string to_text(const SummaryLines& lines) {
    std::string text;
    for (const auto& [file, line] : lines) text += to_json(line) + "\n";
    return text;
}

[[noreturn]] void throw_cannot_append(const std::filesystem::path& file, int error) {
    throw Error(io::write_error_code(error), file.string() +
                                                 ": cannot be written: " + std::generic_category().message(error) +
                                                 "; make room, or choose another output folder");
}

/// Whether a line was cut off at the file's end, by a process killed in the middle of writing it.
bool ends_in_half_line(int descriptor) {
    const ::off_t size = ::lseek(descriptor, 0, SEEK_END);
    char last = '\n';
    return size > 0 && ::pread(descriptor, &last, 1, size - 1) == 1 && last != '\n';
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }
std::string read_text(const Json& value) { return value.is_null() ? "" : value.get<std::string>(); }

/// To a thousandth.
Json number_or_null(const std::optional<double>& number) {
    return number ? Json(std::round(*number * 1000) / 1000) : Json(nullptr);
}

std::optional<double> read_number(const Json& fields, const char* key) {
    if (!fields.contains(key) || fields.at(key).is_null()) return std::nullopt;
    return fields.at(key).get<double>();
}

} // namespace

std::string to_json(const SummaryLine& line) {
    Json also = Json::object();
    for (const auto& [part, error] : line.also) also[part] = text_or_null(error);
    const Json json{{"file", line.file},
                    {"status", line.status},
                    {"error", text_or_null(line.error)},
                    {"code", text_or_null(line.code)},
                    {"seconds", std::round(line.seconds * 1000) / 1000},
                    {"faces", line.faces},
                    {"warnings", line.warnings},
                    {"input", line.input},
                    {"output", line.output},
                    {"sides_confidence", number_or_null(line.sides_confidence)},
                    {"least_confidence", number_or_null(line.least_confidence)},
                    {"also", also}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

SummaryLine parse_summary_line(const std::string& json) {
    try {
        const Json fields = Json::parse(json);
        SummaryLine line;
        line.file = fields.at("file").get<std::string>();
        line.status = fields.at("status").get<std::string>();
        line.error = read_text(fields.at("error"));
        line.seconds = fields.at("seconds").get<double>();
        if (!fields.at("faces").is_number_integer()) throw Error(ErrorCode::bad_input, "no summary line: faces");
        line.faces = fields.at("faces").get<std::int64_t>();
        line.warnings = fields.at("warnings").get<std::vector<std::string>>();
        // Earlier versions did not write what follows.
        line.input = fields.value("input", std::string());
        line.output = fields.value("output", std::string());
        if (fields.contains("code")) line.code = read_text(fields.at("code"));
        line.sides_confidence = read_number(fields, "sides_confidence");
        line.least_confidence = read_number(fields, "least_confidence");
        const Json also = fields.value("also", Json::object());
        for (const auto& [part, error] : also.items()) line.also[part] = read_text(error);
        return line;
    } catch (const Json::exception& error) {
        throw Error(ErrorCode::bad_input, std::string("no summary line: ") + error.what());
    }
}

SummaryContent read_summary(const std::filesystem::path& file) {
    std::error_code error;
    std::ifstream stream;
    if (std::filesystem::is_regular_file(file, error)) stream.open(file, std::ios::binary); // a pipe would never end
    if (!stream.is_open())
        throw Error(ErrorCode::bad_input,
                    file.string() + ": is not there or cannot be read; name folders that skelgen batch has written to");
    return parse_lines(stream);
}

BatchSummary::BatchSummary(std::filesystem::path folder)
    : folder_(std::move(folder)), file_(folder_ / "summary.jsonl") {}

void BatchSummary::append(const SummaryLine& line) const {
    const FolderLock lock(folder_);
    const int descriptor = ::open(file_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) throw_cannot_append(file_, errno);
    const std::string text = (ends_in_half_line(descriptor) ? "\n" : "") + to_json(line) + "\n";
    const ::ssize_t written = ::write(descriptor, text.data(), text.size());
    const int error = written < 0 ? errno : ENOSPC;
    ::close(descriptor);
    if (written != static_cast<::ssize_t>(text.size())) throw_cannot_append(file_, error);
}

SummaryLines BatchSummary::update(const std::vector<std::string>& files, const std::vector<SummaryLine>& lines) const {
    const FolderLock lock(folder_);
    SummaryLines all = read_lines(file_);
    for (const std::string& file : files) all.erase(file);
    for (const SummaryLine& line : lines) all[line.file] = line;
    in_file(file_, [&] { io::write_file_atomically(file_, to_text(all)); });
    return all;
}

SummaryLines BatchSummary::read() const {
    const FolderLock lock(folder_);
    return read_lines(file_);
}

} // namespace skelgen::cli
