#include "mesh_parsers.hpp"

#include <cmath>
#include <cstdint>

#include "binary_reader.hpp"
#include "parser_checks.hpp"
#include "text_scanner.hpp"

namespace skelgen::io::detail {
namespace {

/// What the keyword in front of an OFF file promises for each vertex behind its position.
struct OffKeyword {
    bool known = false;
    std::string_view rest; ///< what is stuck to the keyword: "OFF8 6 12" is seen in the wild
    int extra_floats = 0;  ///< in binary files
};

bool take_prefix(std::string_view& text, std::string_view prefix) {
    if (!text.starts_with(prefix)) return false;
    text.remove_prefix(prefix.size());
    return true;
}

OffKeyword parse_keyword(std::string_view word) {
    OffKeyword keyword;
    if (take_prefix(word, "ST")) keyword.extra_floats += 2;
    if (take_prefix(word, "C")) keyword.extra_floats += 4;
    if (take_prefix(word, "N")) keyword.extra_floats += 3;
    keyword.known = take_prefix(word, "OFF") && (word.empty() || (word[0] >= '0' && word[0] <= '9'));
    keyword.rest = word;
    return keyword;
}

void seek_row(TextScanner& scanner, const char* what, std::size_t row, std::size_t rows) {
    if (!scanner.seek_word())
        scanner.fail("the file ends after " + std::to_string(row) + " of " + std::to_string(rows) + " " + what);
}

PolygonMesh parse_text(TextScanner scanner) {
    constexpr std::size_t least_vertex_row = 6, least_face_row = 8; // "0 0 0\n", "3 0 1 2\n"
    const std::size_t vertices =
        checked_count(scanner, scanner.whole_integer("number of vertices"), least_vertex_row, "vertices");
    scanner.seek_word();
    const std::size_t faces = checked_count(scanner, scanner.whole_integer("number of faces"), least_face_row, "faces");
    scanner.skip_line(); // the number of edges, which many writers leave out or get wrong

    PolygonMesh mesh;
    reserve(mesh, vertices, faces);
    for (std::size_t i = 0; i < vertices; ++i) {
        seek_row(scanner, "vertices", i, vertices);
        for (const double coordinate : scanner.coordinates()) mesh.coordinates.push_back(coordinate);
        scanner.skip_line(); // normal, colour, texture coordinates
    }
    for (std::size_t i = 0; i < faces; ++i) {
        seek_row(scanner, "faces", i, faces);
        const int size = checked_size(scanner, scanner.whole_integer("number of corners"));
        mesh.sizes.push_back(size);
        for (int k = 0; k < size; ++k)
            mesh.corners.push_back(checked_index(scanner, scanner.whole_integer("vertex index"), vertices));
        scanner.skip_line(); // colour
    }
    if (scanner.seek_word()) scanner.fail("there are more rows than the header's counts say");
    return mesh;
}

/// Big-endian 32-bit integers and floats, as Geomview writes them.
PolygonMesh parse_binary(BinaryReader reader, int extra_floats) {
    constexpr std::size_t word = 4;
    const std::size_t extra_bytes = word * static_cast<std::size_t>(extra_floats);
    const std::size_t vertices = checked_count(reader, reader.read<std::int32_t>(), 3 * word + extra_bytes, "vertices");
    const std::size_t faces = checked_count(reader, reader.read<std::int32_t>(), 5 * word, "faces");
    reader.skip(word); // the number of edges

    PolygonMesh mesh;
    reserve(mesh, vertices, faces);
    for (std::size_t i = 0; i < vertices; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            mesh.coordinates.push_back(static_cast<double>(reader.read<float>()));
            if (!std::isfinite(mesh.coordinates.back())) reader.fail("a coordinate is not a number or infinite");
        }
        reader.skip(extra_bytes);
    }
    for (std::size_t i = 0; i < faces; ++i) {
        const int size = checked_size(reader, reader.read<std::int32_t>());
        mesh.sizes.push_back(size);
        for (int k = 0; k < size; ++k)
            mesh.corners.push_back(checked_index(reader, reader.read<std::int32_t>(), vertices));
        const std::int32_t colours = reader.read<std::int32_t>();
        if (colours < 0) reader.fail("a face's number of colour components is negative");
        reader.skip(word * static_cast<std::size_t>(colours));
    }
    return mesh;
}

} // namespace

bool is_off_keyword(std::string_view word) { return parse_keyword(word).known; }

PolygonMesh parse_off(std::string_view bytes) {
    TextScanner scanner(bytes);
    if (!scanner.seek_word()) scanner.fail("the file is empty");
    const char* const start = scanner.position();
    const auto tail = [&](const char* from) { return bytes.substr(static_cast<std::size_t>(from - bytes.data())); };
    const std::string_view first = scanner.word();
    const OffKeyword keyword = parse_keyword(first);

    // The keyword may be missing.
    const bool headerless = first.find_first_not_of("0123456789") == std::string_view::npos;
    if (!keyword.known && !headerless)
        scanner.fail("neither OFF, COFF, NOFF, STOFF or a mixture of them, nor the number of vertices comes first");
    if (keyword.known && scanner.peek_word() == "BINARY") {
        scanner.skip_line();
        return parse_binary(BinaryReader(tail(scanner.position()), std::endian::big), keyword.extra_floats);
    }
    scanner.move_to(headerless ? start : keyword.rest.data());
    scanner.seek_word();
    return parse_text(scanner);
}

} // namespace skelgen::io::detail
