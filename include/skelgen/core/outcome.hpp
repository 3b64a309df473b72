#pragma once

#include <string>
#include <utility>
#include <variant>

namespace skelgen {

/// Why there is nothing to return, where that is to be expected.
enum class FailureReason {
    no_match, ///< this curve does not fit the template; a finer one, or the surface cut elsewhere, may
    no_body,  ///< the shape is no human body's, whatever the curve
    too_long, ///< the same: it is too thin and long for one, and will be however its surface is mended
};

/// A failure that is to be expected, and what to tell the user.
struct Failure {
    FailureReason reason = FailureReason::no_match;
    std::string what; ///< the violated condition and what to do about it
};

/// A value, or the failure in its place. Exceptions are for bad input and for skelgen's own mistakes; a shape in which
/// no skeleton is found is neither.
template <typename Value>
class [[nodiscard]] Outcome {
public:
    Outcome(Value value) : content_(std::move(value)) {}
    Outcome(Failure failure) : content_(std::move(failure)) {}

    [[nodiscard]] explicit operator bool() const { return std::holds_alternative<Value>(content_); }

    /// The value; there must be one.
    [[nodiscard]] const Value& operator*() const& { return std::get<Value>(content_); }
    [[nodiscard]] Value& operator*() & { return std::get<Value>(content_); }
    [[nodiscard]] Value&& operator*() && { return std::get<Value>(std::move(content_)); }
    [[nodiscard]] const Value* operator->() const { return &std::get<Value>(content_); }
    [[nodiscard]] Value* operator->() { return &std::get<Value>(content_); }

    /// The failure; there must be no value.
    [[nodiscard]] const Failure& failure() const { return std::get<Failure>(content_); }

private:
    std::variant<Value, Failure> content_;
};

} // namespace skelgen
