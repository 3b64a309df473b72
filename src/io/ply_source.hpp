#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "binary_reader.hpp"
#include "ply_header.hpp"
#include "text_scanner.hpp"

/// A PLY file's body, read alike in every encoding.
namespace skelgen::io::detail {

/// Values of a text body: one row a line.
class TextSource {
public:
    explicit TextSource(TextScanner scanner) : scanner_(scanner) {}

    void begin_row() {
        if (!scanner_.seek_word()) fail("the file ends too early");
    }
    void end_row() {
        if (!scanner_.at_line_end()) fail("there are more values than the header's properties");
    }
    void end() {
        if (scanner_.seek_word()) fail("there are more rows than the header's counts say");
    }
    template <typename Number = double>
    Number number(PlyType) {
        return scanner_.number<Number>("value");
    }
    /// NaN where it is no finite number.
    double number_or_nan(PlyType) {
        if (scanner_.at_line_end()) fail("a value is missing");
        return scanner_.try_number().value_or(std::numeric_limits<double>::quiet_NaN());
    }
    std::int64_t integer(PlyType) { return scanner_.whole_integer("whole number"); }
    void skip(PlyType, std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i)
            if (scanner_.word().empty()) fail("a value is missing");
    }

    /// A digit and the blank or end of line behind it.
    [[nodiscard]] static std::size_t least_bytes(PlyType) { return 2; }
    [[nodiscard]] std::size_t bytes_left() const { return scanner_.bytes_left(); }
    [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

private:
    TextScanner scanner_;
};

/// Values of a binary body, one after another without any rows.
class BinarySource {
public:
    explicit BinarySource(BinaryReader reader) : reader_(reader) {}

    void begin_row() {}
    void end_row() {}
    void end() {} // stray bytes are common: line ends added on transfer, comments of programs
    template <typename Number = double>
    Number number(PlyType type) {
        switch (type) {
        case PlyType::float32:
            return static_cast<Number>(reader_.read<float>());
        case PlyType::float64:
            return static_cast<Number>(reader_.read<double>());
        default:
            return static_cast<Number>(integer(type));
        }
    }
    double number_or_nan(PlyType type) { return number(type); }
    std::int64_t integer(PlyType type) {
        switch (type) {
        case PlyType::int8:
            return reader_.read<std::int8_t>();
        case PlyType::uint8:
            return reader_.read<std::uint8_t>();
        case PlyType::int16:
            return reader_.read<std::int16_t>();
        case PlyType::uint16:
            return reader_.read<std::uint16_t>();
        case PlyType::int32:
            return reader_.read<std::int32_t>();
        case PlyType::uint32:
            return reader_.read<std::uint32_t>();
        default:
            fail("a whole number was expected");
        }
    }
    void skip(PlyType type, std::int64_t count) { reader_.skip(size_of(type) * static_cast<std::size_t>(count)); }

    [[nodiscard]] static std::size_t least_bytes(PlyType type) { return size_of(type); }
    [[nodiscard]] std::size_t bytes_left() const { return reader_.bytes_left(); }
    [[noreturn]] void fail(const std::string& message) const { reader_.fail(message); }

private:
    BinaryReader reader_;
};

inline constexpr int not_found = -1;

[[nodiscard]] inline int find_property(const PlyElement& element, std::string_view name) {
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (element.properties[i].name == name) return static_cast<int>(i);
    return not_found;
}

/// Fewest bytes that a row of this element takes.
template <typename Source>
[[nodiscard]] std::size_t least_row_bytes(const PlyElement& element) {
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties)
        bytes += Source::least_bytes(property.length_type.value_or(property.type));
    return bytes;
}

template <typename Source>
void skip_value(Source& source, const PlyProperty& property) {
    std::int64_t count = 1;
    if (property.length_type) count = source.integer(*property.length_type);
    if (count < 0) source.fail("the length of a list is negative");
    source.skip(property.type, count);
}

template <typename Source>
void skip_rows(Source& source, const PlyElement& element, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        source.begin_row();
        for (const PlyProperty& property : element.properties) skip_value(source, property);
        source.end_row();
    }
}

} // namespace skelgen::io::detail
