#include "mesh_parsers.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/parallel.hpp>

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

/// What a header promises.
struct OffCounts {
    std::size_t vertices, faces;
};

void read_off_vertex(TextScanner& scanner, double* place) {
    for (const double coordinate : scanner.coordinates()) *place++ = coordinate;
    scanner.skip_line(); // normal, colour, texture coordinates
}

/// \returns the number of its corners, which come behind `corners`.
int read_off_face(TextScanner& scanner, std::size_t vertices, std::vector<int>& corners) {
    const int size = checked_size(scanner, scanner.whole_integer("number of corners"));
    for (int k = 0; k < size; ++k)
        corners.push_back(checked_index(scanner, scanner.whole_integer("vertex index"), vertices));
    scanner.skip_line(); // colour
    return size;
}

PolygonMesh read_off_rows(TextScanner scanner, const OffCounts& counts) {
    PolygonMesh mesh;
    reserve(mesh, counts.vertices, counts.faces);
    mesh.coordinates.resize(3 * counts.vertices);
    for (std::size_t i = 0; i < counts.vertices; ++i) {
        seek_row(scanner, "vertices", i, counts.vertices);
        read_off_vertex(scanner, &mesh.coordinates[3 * i]);
    }
    for (std::size_t i = 0; i < counts.faces; ++i) {
        seek_row(scanner, "faces", i, counts.faces);
        mesh.sizes.push_back(read_off_face(scanner, counts.vertices, mesh.corners));
    }
    if (scanner.seek_word()) scanner.fail("there are more rows than the header's counts say");
    return mesh;
}

/// The lines of a text in blocks of about so many bytes.
std::vector<std::string_view> blocks_of_lines(std::string_view text, std::size_t bytes) {
    std::vector<std::string_view> out;
    while (!text.empty()) {
        const std::size_t end = text.size() > bytes ? text.find('\n', bytes) : std::string_view::npos;
        out.push_back(text.substr(0, end == std::string_view::npos ? end : end + 1));
        text.remove_prefix(out.back().size());
    }
    return out;
}

std::size_t off_rows_in(std::string_view block) {
    TextScanner scanner(block);
    std::size_t rows = 0;
    for (; scanner.seek_word(); scanner.skip_line()) ++rows;
    return rows;
}

/// The same in blocks, by as many threads as there are; none where that takes a look at the whole: of lines that go on
/// in the next one, and of what is wrong.
std::optional<PolygonMesh> read_off_blocks(std::string_view text, const OffCounts& counts) {
    constexpr std::size_t block_bytes = std::size_t(1) << 18;
    if (text.size() < 2 * block_bytes || text.find('\\') != std::string_view::npos) return std::nullopt;
    const std::vector<std::string_view> blocks = blocks_of_lines(text, block_bytes);
    std::vector<std::size_t> rows(blocks.size()), first(blocks.size(), 0);
    core::parallel_for(blocks.size(), 1, [&](std::size_t b) { rows[b] = off_rows_in(blocks[b]); });
    for (std::size_t b = 1; b < blocks.size(); ++b) first[b] = first[b - 1] + rows[b - 1];
    if (first.back() + rows.back() != counts.vertices + counts.faces) return std::nullopt;

    PolygonMesh mesh;
    reserve(mesh, 0, counts.faces);
    mesh.coordinates.resize(3 * counts.vertices);
    std::vector<PolygonMesh> faces(blocks.size());
    try {
        core::parallel_for(blocks.size(), 1, [&](std::size_t b) {
            TextScanner scanner(blocks[b]);
            for (std::size_t row = first[b]; scanner.seek_word(); ++row)
                if (row < counts.vertices)
                    read_off_vertex(scanner, &mesh.coordinates[3 * row]);
                else
                    faces[b].sizes.push_back(read_off_face(scanner, counts.vertices, faces[b].corners));
        });
    } catch (const Error&) {
        return std::nullopt; // again from the beginning, for the number of the line
    }
    for (PolygonMesh& part : faces) {
        mesh.sizes.insert(mesh.sizes.end(), part.sizes.begin(), part.sizes.end());
        mesh.corners.insert(mesh.corners.end(), part.corners.begin(), part.corners.end());
        part = {};
    }
    return mesh;
}

PolygonMesh parse_text(TextScanner scanner) {
    constexpr std::size_t least_vertex_row = 6, least_face_row = 8; // "0 0 0\n", "3 0 1 2\n"
    const std::size_t vertices =
        checked_count(scanner, scanner.whole_integer("number of vertices"), least_vertex_row, "vertices");
    scanner.seek_word();
    const std::size_t faces = checked_count(scanner, scanner.whole_integer("number of faces"), least_face_row, "faces");
    scanner.skip_line(); // the number of edges, which many writers leave out or get wrong
    const OffCounts counts{vertices, faces};
    if (auto mesh = read_off_blocks({scanner.position(), scanner.bytes_left()}, counts)) return *std::move(mesh);
    return read_off_rows(scanner, counts);
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
        scanner.fail("the mesh begins neither with OFF (or COFF, NOFF, STOFF) nor with the number of vertices");
    if (keyword.known && scanner.peek_word() == "BINARY") {
        scanner.skip_line();
        return parse_binary(BinaryReader(tail(scanner.position()), std::endian::big), keyword.extra_floats);
    }
    scanner.move_to(headerless ? start : keyword.rest.data());
    scanner.seek_word();
    return parse_text(scanner);
}

} // namespace skelgen::io::detail
