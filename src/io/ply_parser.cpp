#include "mesh_parsers.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "binary_reader.hpp"
#include "parser_checks.hpp"
#include "ply_header.hpp"
#include "text_scanner.hpp"

namespace skelgen::io::detail {
namespace {

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
    double number(PlyType) { return scanner_.number("value"); }
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
    double number(PlyType type) {
        switch (type) {
        case PlyType::float32:
            return static_cast<double>(reader_.read<float>());
        case PlyType::float64:
            return reader_.read<double>();
        default:
            return static_cast<double>(integer(type));
        }
    }
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

constexpr int not_found = -1;

int find_property(const PlyElement& element, std::string_view name) {
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (element.properties[i].name == name) return static_cast<int>(i);
    return not_found;
}

/// Fills a PolygonMesh from a body whose values come from `Source`.
template <typename Source>
class PlyBody {
public:
    PlyBody(Source source, std::size_t vertices) : source_(std::move(source)), vertices_(vertices) {}

    PolygonMesh parse(const PlyHeader& header) {
        for (const PlyElement& element : header.elements) {
            if (element.properties.empty()) continue; // rows of nothing
            const std::size_t count =
                checked_count(source_, element.count, least_row_bytes(element), "rows of an element");
            if (element.name == "vertex")
                read_vertices(element, count);
            else if (element.name == "face")
                read_faces(element, count);
            else
                skip_rows(element, count);
        }
        source_.end();
        return std::move(mesh_);
    }

private:
    [[nodiscard]] static std::size_t least_row_bytes(const PlyElement& element) {
        std::size_t bytes = 0;
        for (const PlyProperty& property : element.properties)
            bytes += Source::least_bytes(property.length_type.value_or(property.type));
        return bytes;
    }

    void read_vertices(const PlyElement& element, std::size_t count) {
        const std::array<int, 3> axes{find_property(element, "x"), find_property(element, "y"),
                                      find_property(element, "z")};
        for (const int axis : axes)
            if (axis == not_found || element.properties[static_cast<std::size_t>(axis)].length_type)
                source_.fail("the element 'vertex' lacks a property x, y or z");
        mesh_.coordinates.reserve(3 * count);
        std::vector<double> row(element.properties.size()); // lists stay 0
        for (std::size_t i = 0; i < count; ++i) {
            source_.begin_row();
            for (std::size_t k = 0; k < row.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                if (is_one_of(axes, k))
                    row[k] = source_.number(property.type);
                else
                    skip_value(property);
            }
            source_.end_row();
            for (const int axis : axes) add_coordinate(row[static_cast<std::size_t>(axis)]);
        }
    }

    [[nodiscard]] static bool is_one_of(const std::array<int, 3>& axes, std::size_t k) {
        const int i = static_cast<int>(k);
        return i == axes[0] || i == axes[1] || i == axes[2];
    }

    void add_coordinate(double value) {
        if (!std::isfinite(value)) source_.fail("a coordinate is not a number or infinite");
        mesh_.coordinates.push_back(value);
    }

    void read_faces(const PlyElement& element, std::size_t count) {
        int corners = find_property(element, "vertex_indices");
        if (corners == not_found) corners = find_property(element, "vertex_index");
        if (corners == not_found || !element.properties[static_cast<std::size_t>(corners)].length_type)
            source_.fail("the element 'face' lacks a list vertex_indices");
        const auto corners_at = static_cast<std::size_t>(corners);
        if (!is_integer(element.properties[corners_at].type))
            source_.fail("the list vertex_indices must be of an integer type");
        mesh_.sizes.reserve(count);
        mesh_.corners.reserve(3 * count);
        for (std::size_t i = 0; i < count; ++i) {
            source_.begin_row();
            for (std::size_t k = 0; k < element.properties.size(); ++k) {
                if (k == corners_at)
                    read_corners(element.properties[k]);
                else
                    skip_value(element.properties[k]);
            }
            source_.end_row();
        }
    }

    void read_corners(const PlyProperty& list) {
        const int size = checked_size(source_, source_.integer(*list.length_type));
        mesh_.sizes.push_back(size);
        for (int i = 0; i < size; ++i)
            mesh_.corners.push_back(checked_index(source_, source_.integer(list.type), vertices_));
    }

    void skip_value(const PlyProperty& property) {
        std::int64_t count = 1;
        if (property.length_type) count = source_.integer(*property.length_type);
        if (count < 0) source_.fail("the length of a list is negative");
        source_.skip(property.type, count);
    }

    void skip_rows(const PlyElement& element, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            source_.begin_row();
            for (const PlyProperty& property : element.properties) skip_value(property);
            source_.end_row();
        }
    }

    Source source_;
    PolygonMesh mesh_;
    std::size_t vertices_; ///< how many the header promises: faces may come before them
};

std::size_t vertex_count(const PlyHeader& header) {
    std::size_t count = 0;
    for (const PlyElement& element : header.elements)
        if (element.name == "vertex") count += static_cast<std::size_t>(element.count);
    return count;
}

} // namespace

PolygonMesh parse_ply(std::string_view bytes) {
    TextScanner scanner(bytes);
    const PlyHeader header = parse_ply_header(scanner);
    const std::size_t vertices = vertex_count(header);
    if (header.encoding == PlyEncoding::text) return PlyBody(TextSource(scanner), vertices).parse(header);

    const std::string_view body = bytes.substr(bytes.size() - scanner.bytes_left());
    const auto order = header.encoding == PlyEncoding::little_endian ? std::endian::little : std::endian::big;
    return PlyBody(BinarySource(BinaryReader(body, order)), vertices).parse(header);
}

} // namespace skelgen::io::detail
