#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include <skelgen/core/refusal.hpp>

namespace skelgen {

/// What a caller can do about a failure; the values are the exit statuses of the command line (5 is a batch's).
enum class ErrorCode {
    internal = 1,    ///< a fault of skelgen's own: report it
    usage = 2,       ///< an argument or option that makes no sense: change the call
    bad_input = 3,   ///< the input cannot be read or is no mesh: repair the file
    no_skeleton = 4, ///< a sound mesh in which no human skeleton could be found
    not_written = 6, ///< the result cannot be stored (a full disk, say): make room
};

/// As results name it: "usage", "bad_input", "no_skeleton", "not_written"; "internal" for all others.
[[nodiscard]] constexpr std::string_view to_string(ErrorCode code) {
    switch (code) {
    case ErrorCode::usage:
        return "usage";
    case ErrorCode::bad_input:
        return "bad_input";
    case ErrorCode::no_skeleton:
        return "no_skeleton";
    case ErrorCode::not_written:
        return "not_written";
    case ErrorCode::internal:
        break;
    }
    return "internal";
}

/// The one exception type that skelgen throws. `what()` states the violated condition and what to do about it,
/// without the file's name: the caller knows it and puts it in front.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& what, Refusal refusal = Refusal::none)
        : std::runtime_error(what), code_(code), refusal_(refusal) {}

    [[nodiscard]] ErrorCode code() const noexcept { return code_; }

    /// Why no skeleton was found; none where the code is another one than no_skeleton.
    [[nodiscard]] Refusal refusal() const noexcept { return refusal_; }

private:
    ErrorCode code_;
    Refusal refusal_;
};

} // namespace skelgen
