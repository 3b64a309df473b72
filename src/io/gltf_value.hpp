#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace skelgen::io::detail {

/// A value of a glTF file's JSON that knows its place in it, for messages: "accessors[3].count". What it is asked for
/// is there and of the type asked for, or Error bad_input says which is not. Refers to the JSON: must not outlive it.
class GltfValue {
public:
    using Json = nlohmann::json; // keys sorted: a hostile object of a million keys is still read in no time

    GltfValue(const Json& json, std::string place) : json_(&json), place_(std::move(place)) {}

    /// The member of an object; none where it lacks it. Fails when this is no object.
    [[nodiscard]] std::optional<GltfValue> find(const char* key) const;
    /// The member of an object, which must be there.
    [[nodiscard]] GltfValue at(const char* key) const;

    /// Of a list: its length and its elements. Fails when this is no list, or has no such element.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] GltfValue operator[](std::size_t i) const;

    /// A whole number from 0 to 2^40: what any count, offset or index of a file may be, and no sum of two overflows.
    [[nodiscard]] std::size_t whole_number() const;
    /// The member's whole number, or `fallback` where there is no such member.
    [[nodiscard]] std::size_t whole_number(const char* key, std::size_t fallback) const;
    [[nodiscard]] double number() const;
    [[nodiscard]] bool truth(const char* key, bool fallback) const;
    [[nodiscard]] const std::string& text() const;

    /// The keys of an object and what they stand for, in alphabetic order.
    [[nodiscard]] const Json::object_t& members() const;

    [[noreturn]] void fail(const std::string& message) const;

private:
    const Json* json_;
    std::string place_;
};

} // namespace skelgen::io::detail
