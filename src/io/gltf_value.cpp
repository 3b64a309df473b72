#include "gltf_value.hpp"

#include <cmath>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {
namespace {

constexpr double largest_whole_number = 1099511627776.0; // 2^40

} // namespace

void GltfValue::fail(const std::string& message) const {
    throw Error(ErrorCode::bad_input, "glTF: " + (place_.empty() ? "the file" : place_) + ' ' + message +
                                          "; repair or export the scene again");
}

const GltfValue::Json::object_t& GltfValue::members() const {
    if (!json_->is_object()) fail("is no object");
    return json_->get_ref<const Json::object_t&>();
}

std::optional<GltfValue> GltfValue::find(const char* key) const {
    const Json::object_t& object = members();
    const auto member = object.find(key);
    if (member == object.end()) return std::nullopt;
    return GltfValue(member->second, place_.empty() ? key : place_ + '.' + key);
}

GltfValue GltfValue::at(const char* key) const {
    auto member = find(key);
    if (!member) fail("has no \"" + std::string(key) + '"');
    return *std::move(member);
}

std::size_t GltfValue::size() const {
    if (!json_->is_array()) fail("is no list");
    return json_->size();
}

GltfValue GltfValue::operator[](std::size_t i) const {
    const std::size_t elements = size();
    if (i >= elements)
        fail("has " + std::to_string(elements) + " elements, but number " + std::to_string(i) +
             " (counted from 0) is referred to");
    return {(*json_)[i], place_ + '[' + std::to_string(i) + ']'};
}

std::size_t GltfValue::whole_number() const {
    const double value = json_->is_number() ? json_->get<double>() : -1; // some exporters write 3.0
    if (!(value >= 0 && value <= largest_whole_number) || value != std::floor(value))
        fail("is no whole number from 0 to 2^40");
    return static_cast<std::size_t>(value);
}

std::size_t GltfValue::whole_number(const char* key, std::size_t fallback) const {
    const auto member = find(key);
    return member ? member->whole_number() : fallback;
}

double GltfValue::number() const {
    if (!json_->is_number()) fail("is no number");
    return json_->get<double>(); // finite: JSON has no other numbers
}

bool GltfValue::truth(const char* key, bool fallback) const {
    const auto member = find(key);
    if (!member) return fallback;
    if (!member->json_->is_boolean()) member->fail("is neither true nor false");
    return member->json_->get<bool>();
}

const std::string& GltfValue::text() const {
    if (!json_->is_string()) fail("is no string");
    return json_->get_ref<const std::string&>();
}

} // namespace skelgen::io::detail
