#include "mesh_parsers.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "parser_checks.hpp"
#include "ply_source.hpp"

namespace skelgen::io::detail {
namespace {

/// Fills a PolygonMesh from a body whose values come from `Source`.
template <typename Source>
class PlyBody {
public:
    PlyBody(Source source, std::size_t vertices) : source_(std::move(source)), vertices_(vertices) {}

    PolygonMesh parse(const PlyHeader& header) {
        for (const PlyElement& element : header.elements) {
            if (element.properties.empty()) continue; // rows of nothing
            const std::size_t count =
                checked_count(source_, element.count, least_row_bytes<Source>(element), "rows of an element");
            if (element.name == "vertex")
                read_vertices(element, count);
            else if (element.name == "face")
                read_faces(element, count);
            else
                skip_rows(source_, element, count);
        }
        source_.end();
        return std::move(mesh_);
    }

private:
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
                    skip_value(source_, property);
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
                    skip_value(source_, element.properties[k]);
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
