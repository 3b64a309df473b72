#include "ply_header.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace skelgen::io::detail {
namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};

constexpr std::array<TypeName, 16> type_names{{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

PlyType parse_type(const TextScanner& scanner, std::string_view word) {
    for (const auto& [name, type] : type_names)
        if (word == name) return type;
    scanner.fail("a property's type is none of PLY's (char, uchar, ..., float, double)");
}

PlyEncoding parse_encoding(TextScanner& scanner) {
    const std::string_view word = scanner.word();
    if (word == "ascii") return PlyEncoding::text;
    if (word == "binary_little_endian") return PlyEncoding::little_endian;
    if (word == "binary_big_endian") return PlyEncoding::big_endian;
    scanner.fail("the format is none of ascii, binary_little_endian, binary_big_endian");
}

PlyElement parse_element(TextScanner& scanner) {
    PlyElement element;
    element.name = scanner.word();
    element.count = scanner.whole_integer("number of elements");
    if (element.count < 0) scanner.fail("the number of elements is negative");
    return element;
}

PlyProperty parse_property(TextScanner& scanner) {
    PlyProperty property;
    std::string_view word = scanner.word();
    if (word == "list") {
        property.length_type = parse_type(scanner, scanner.word());
        if (!is_integer(*property.length_type)) scanner.fail("the length of a list must be of an integer type");
        word = scanner.word();
    }
    property.type = parse_type(scanner, word);
    property.name = scanner.word();
    if (property.name.empty()) scanner.fail("a property has no name");
    return property;
}

} // namespace

PlyHeader parse_ply_header(TextScanner& scanner) {
    if (!scanner.seek_word() || scanner.word() != "ply") scanner.fail("'ply' does not come first");
    scanner.skip_line();

    PlyHeader header;
    bool has_format = false;
    while (scanner.seek_word()) {
        const std::string_view keyword = scanner.word();
        if (keyword == "end_header") {
            if (!has_format) scanner.fail("the header names no format");
            scanner.skip_line();
            return header;
        }
        if (keyword == "format") {
            header.encoding = parse_encoding(scanner);
            has_format = true;
        } else if (keyword == "element") {
            header.elements.push_back(parse_element(scanner));
        } else if (keyword == "property") {
            if (header.elements.empty()) scanner.fail("a property comes before the first element");
            header.elements.back().properties.push_back(parse_property(scanner));
        } else if (keyword == "comment") {
            if (scanner.word() == "TextureFile") header.texture_file = scanner.peek_rest_of_line();
        } else if (keyword != "obj_info") {
            scanner.fail("the header's line begins with no word that PLY knows");
        }
        scanner.skip_line();
    }
    scanner.fail("the header has no end_header: the file is cut short");
}

} // namespace skelgen::io::detail
