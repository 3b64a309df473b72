#pragma once

#include <string>
#include <utility>
#include <variant>

#include <skelgen/core/refusal.hpp>

namespace skelgen {

/// A failure that is to be expected, and what to tell the user.
struct Failure {
    Refusal reason = Refusal::none; ///< none: not a skeleton was looked for, but something else
    std::string what;               ///< the violated condition and what to do about it
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
