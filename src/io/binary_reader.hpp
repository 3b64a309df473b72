#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include <skelgen/core/error.hpp>

#include "bit_cast.hpp"

namespace skelgen::io::detail {

/// Walks once through binary data of either byte order, never past its end.
class BinaryReader {
public:
    /// `content` names what the bytes are, for the advice in errors.
    BinaryReader(std::string_view bytes, std::endian order, const char* content = "mesh")
        : bytes_(bytes), order_(order), content_(content) {}

    template <typename T>
    [[nodiscard]] T read() {
        std::array<char, sizeof(T)> raw;
        std::memcpy(raw.data(), need(sizeof(T)), sizeof(T));
        if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
        at_ += sizeof(T);
        return bit_cast<T>(raw);
    }

    void skip(std::size_t count) {
        static_cast<void>(need(count));
        at_ += count;
    }

    [[nodiscard]] std::size_t bytes_left() const { return bytes_.size() - at_; }

    [[noreturn]] void fail(const std::string& message) const {
        throw Error(ErrorCode::bad_input,
                    "byte " + std::to_string(at_) + ": " + message + "; repair or export the " + content_ + " again");
    }

private:
    [[nodiscard]] const char* need(std::size_t count) const {
        if (bytes_left() < count) fail("the file ends too early");
        return bytes_.data() + at_;
    }

    std::string_view bytes_;
    std::endian order_;
    const char* content_;
    std::size_t at_ = 0;
};

} // namespace skelgen::io::detail
