#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include <fast_float/fast_float.h>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {

/// Walks once through a text of lines and blank-separated words. `#` starts a comment, a backslash at the end of a line
/// continues it. Lines are only counted when an error has to name one.
class TextScanner {
public:
    /// `content` names what the text is, for the advice in errors.
    explicit TextScanner(std::string_view text, const char* content = "mesh")
        : begin_(text.data()), at_(begin_), end_(begin_ + text.size()), content_(content) {}

    /// Moves past blanks and comments; true when nothing is left on this line.
    [[nodiscard]] bool at_line_end() {
        skip_blanks();
        return at_ == end_ || *at_ == '\n' || *at_ == '#';
    }

    /// Moves to the next word, over ends of lines and comments; false at the end of the text.
    bool seek_word() {
        while (at_line_end()) {
            if (at_ == end_) return false;
            skip_line();
        }
        return true;
    }

    /// Moves to the next word or comment, over ends of lines; false at the end of the text.
    bool seek_word_or_comment() {
        for (skip_blanks(); at_ != end_ && *at_ == '\n'; skip_blanks()) ++at_;
        return at_ != end_;
    }

    /// Moves to the beginning of the next line.
    void skip_line() {
        const void* const line_end = std::memchr(at_, '\n', bytes_left());
        at_ = line_end == nullptr ? end_ : static_cast<const char*>(line_end) + 1;
    }

    /// Moves to the beginning of the next line that does not continue this one.
    void skip_continued_line() {
        for (const char* start = at_;; start = at_) {
            skip_line();
            if (!is_continued({start, static_cast<std::size_t>(at_ - start)})) return;
        }
    }

    /// The next word of this line; empty when there is none.
    [[nodiscard]] std::string_view word() {
        if (at_line_end()) return {};
        const char* const start = at_;
        while (at_ != end_ && !is_space(*at_)) ++at_;
        return {start, static_cast<std::size_t>(at_ - start)};
    }

    /// The next word of this line, without moving.
    [[nodiscard]] std::string_view peek_word() const {
        TextScanner ahead = *this;
        return ahead.word();
    }

    /// The next word of this line as a finite number, the one of its type that is nearest to the word. `what` names it
    /// in the error.
    template <typename Number = double>
    Number number(const char* what) {
        skip_blanks();
        const char* const start = at_;
        if (at_ != end_ && *at_ == '+') ++at_;
        Number value = 0;
        const char* const stop = fast_float::from_chars(at_, end_, value).ptr;
        // The result's error code is not asked: what overflows is infinite, what underflows is a good zero.
        if (stop == at_ || (stop != end_ && !is_space(*stop) && *stop != '#')) fail_to_read(start, what);
        if (!std::isfinite(value)) fail_to_read(start, what);
        at_ = stop;
        return value;
    }

    /// The next word of this line as a number, where it is a finite one; else none, and the word is skipped.
    std::optional<double> try_number() {
        skip_blanks();
        if (at_ != end_ && *at_ == '+') ++at_;
        double value = 0;
        const char* const stop = fast_float::from_chars(at_, end_, value).ptr;
        const bool is_number = stop != at_ && (stop == end_ || is_space(*stop) || *stop == '#');
        at_ = is_number ? stop : at_;
        if (!is_number) skip_rest_of_word();
        return is_number && std::isfinite(value) ? std::optional(value) : std::nullopt;
    }

    /// What is left of this line, as names of files have it: blanks within, none around; up to a comment behind a
    /// blank.
    [[nodiscard]] std::string_view rest_of_line() {
        skip_blanks();
        const char* const start = at_;
        skip_line();
        const char* stop = start;
        for (const char* c = start; c != at_ && *c != '\n'; ++c) {
            if (*c == '#' && (c == start || is_space(c[-1]))) break;
            if (!is_space(*c)) stop = c + 1;
        }
        return {start, static_cast<std::size_t>(stop - start)};
    }

    /// What `rest_of_line` gives, without moving.
    [[nodiscard]] std::string_view peek_rest_of_line() const {
        TextScanner ahead = *this;
        return ahead.rest_of_line();
    }

    /// The next three words of this line as the coordinates of a point.
    template <typename Number = double>
    std::array<Number, 3> coordinates() {
        const auto x = number<Number>("x coordinate"), y = number<Number>("y coordinate"),
                   z = number<Number>("z coordinate");
        return {x, y, z};
    }

    /// An integer that begins the next word of this line; the rest of the word is left (OBJ's "1/2/3").
    std::int64_t integer(const char* what) {
        skip_blanks();
        const char* const start = at_;
        if (at_ != end_ && *at_ == '+') ++at_;
        const bool negative = take('-');
        const char* const digits = at_;
        std::int64_t value = 0;
        constexpr int most_digits = 18; // what always fits
        while (at_ != end_ && is_digit(*at_) && at_ - digits < most_digits) value = 10 * value + (*at_++ - '0');
        if (at_ == digits || (at_ != end_ && is_digit(*at_))) fail_to_read(start, what);
        return negative ? -value : value;
    }

    /// An integer that comes at once and is no longer than one may be; none, without moving, where there is none.
    std::optional<std::int64_t> try_integer() {
        const char* at = at_;
        const bool negative = at != end_ && *at == '-';
        if (negative) ++at;
        const char* const digits = at;
        std::int64_t value = 0;
        constexpr int most_digits = 18; // what always fits
        while (at != end_ && is_digit(*at) && at - digits < most_digits) value = 10 * value + (*at++ - '0');
        if (at == digits || (at != end_ && is_digit(*at))) return std::nullopt;
        at_ = at;
        return negative ? -value : value;
    }

    /// The next word of this line as an integer.
    std::int64_t whole_integer(const char* what) {
        skip_blanks();
        const char* const start = at_;
        const std::int64_t value = integer(what);
        if (!at_word_end()) fail_to_read(start, what);
        return value;
    }

    /// Takes `c` if it is the very next character.
    bool take(char c) {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }

    /// Takes `text` if it is what comes next, be it in a comment.
    bool take(std::string_view text) {
        if (!std::string_view(at_, bytes_left()).starts_with(text)) return false;
        at_ += text.size();
        return true;
    }

    /// Whether a comment begins here.
    [[nodiscard]] bool at_comment() const { return at_ != end_ && *at_ == '#'; }

    /// Whether the word ends here.
    [[nodiscard]] bool at_word_end() const { return at_ == end_ || is_space(*at_) || *at_ == '#'; }

    void skip_rest_of_word() {
        while (!at_word_end()) ++at_;
    }

    [[nodiscard]] std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
    [[nodiscard]] const char* position() const { return at_; }

    /// Goes to a place in the text that `position` or `word` gave.
    void move_to(const char* place) { at_ = place; }

    [[noreturn]] void fail(const std::string& message) const { fail_at(at_, message); }

    [[noreturn]] void fail_at(const char* where, const std::string& message) const {
        const auto line = 1 + std::count(begin_, where, '\n');
        throw Error(ErrorCode::bad_input,
                    "line " + std::to_string(line) + ": " + message + "; repair or export the " + content_ + " again");
    }

private:
    [[nodiscard]] static bool is_digit(char c) { return c >= '0' && c <= '9'; }

    /// All control characters but the end of a line count as blanks; a zero byte does not: no text has any.
    [[nodiscard]] static bool is_space(char c) { return static_cast<unsigned char>(c - 1) < ' '; }
    [[nodiscard]] static bool is_blank(char c) { return is_space(c) && c != '\n'; }

    void skip_blanks() {
        while (at_ != end_ && (is_blank(*at_) || (*at_ == '\\' && take_continuation()))) ++at_;
    }

    /// Whether the line ends with a backslash that is a word of its own, and in no comment.
    [[nodiscard]] static bool is_continued(std::string_view line) {
        if (!line.ends_with('\n')) return false;
        line.remove_suffix(1);
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (!line.ends_with('\\')) return false;
        line.remove_suffix(1);
        return (line.empty() || is_space(line.back())) && line.find('#') == std::string_view::npos;
    }

    /// At a backslash: if the line ends after it, moves to that end.
    bool take_continuation() {
        const char* next = at_ + 1;
        if (next != end_ && *next == '\r') ++next;
        if (next == end_ || *next != '\n') return false;
        at_ = next;
        return true;
    }

    [[noreturn]] void fail_to_read(const char* start, const char* what) const {
        TextScanner bad = *this;
        bad.at_ = start;
        constexpr std::size_t longest = 30;
        const std::string_view found = bad.word().substr(0, longest);
        if (found.empty()) fail_at(start, std::string("the ") + what + " is missing");
        fail_at(start, std::string("the ") + what + " is no usable number: '" + printable(found) + "'");
    }

    /// Other bytes would upset terminals and UTF-8 readers of the message.
    [[nodiscard]] static std::string printable(std::string_view text) {
        std::string result(text);
        std::replace_if(
            result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
        return result;
    }

    const char* begin_;
    const char* at_;
    const char* end_;
    const char* content_;
};

} // namespace skelgen::io::detail
