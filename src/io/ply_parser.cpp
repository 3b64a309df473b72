#include "mesh_parsers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "finite_float.hpp"
#include "parser_checks.hpp"
#include "ply_source.hpp"

namespace skelgen::io::detail {
namespace {

/// Where a vertex' looks are among its properties.
struct PlyLookColumns {
    std::array<int, 3> normal{not_found, not_found, not_found};
    std::array<int, 4> colour{not_found, not_found, not_found, not_found}; ///< alpha may be missing

    [[nodiscard]] bool contains(std::size_t k) const {
        const auto is_k = [k](int column) { return column == static_cast<int>(k); };
        return std::any_of(normal.begin(), normal.end(), is_k) || std::any_of(colour.begin(), colour.end(), is_k);
    }
};

/// The columns of properties with these names, of which so many must be there; else none.
template <std::size_t Count>
std::array<int, Count> columns_named(const PlyElement& element, const std::array<const char*, Count>& names,
                                     std::size_t needed) {
    std::array<int, Count> columns{};
    for (std::size_t i = 0; i < Count; ++i) {
        const int column = find_property(element, names[i]);
        const bool is_one = column != not_found && !element.properties[static_cast<std::size_t>(column)].length_type;
        columns[i] = is_one ? column : not_found;
    }
    if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(needed), not_found) !=
        columns.begin() + static_cast<std::ptrdiff_t>(needed))
        columns.fill(not_found);
    return columns;
}

PlyLookColumns look_columns(const PlyElement& vertex) {
    PlyLookColumns columns;
    columns.normal = columns_named<3>(vertex, {"nx", "ny", "nz"}, 3);
    columns.colour = columns_named<4>(vertex, {"red", "green", "blue", "alpha"}, 3);
    if (columns.colour[0] == not_found)
        columns.colour = columns_named<4>(vertex, {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}, 3);
    return columns;
}

/// Colours as parts of the most that their type holds; real ones are from 0 to 1 already, unless they go beyond.
void bring_to_unit(std::vector<float>& colours, const PlyElement& vertex, const PlyLookColumns& columns) {
    if (colours.empty()) return;
    constexpr float byte = 255, word = 65535;
    const PlyType type = vertex.properties[static_cast<std::size_t>(columns.colour[0])].type;
    float most = type == PlyType::uint16 ? word : byte;
    if (!is_integer(type) && std::none_of(colours.begin(), colours.end(), [](float c) { return c > 1 && c <= byte; }))
        most = 1;
    for (float& channel : colours) channel = std::clamp(channel / most, 0.0F, 1.0F);
}

/// Fills a PolygonMesh from a body whose values come from `Source`.
template <typename Source>
class PlyBody {
public:
    /// `looks`: where those are to go, if they are wanted.
    PlyBody(Source source, std::size_t vertices, PlyFile* looks)
        : source_(std::move(source)), vertices_(vertices), looks_(looks) {}

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
        const PlyLookColumns columns = looks_ != nullptr ? look_columns(element) : PlyLookColumns{};
        std::vector<double> row(element.properties.size()); // lists stay 0
        for (std::size_t i = 0; i < count; ++i) {
            source_.begin_row();
            for (std::size_t k = 0; k < row.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                if (is_one_of(axes, k))
                    row[k] = source_.number(property.type);
                else if (columns.contains(k))
                    row[k] = source_.number_or_nan(property.type);
                else
                    skip_value(source_, property);
            }
            source_.end_row();
            for (const int axis : axes) add_coordinate(row[static_cast<std::size_t>(axis)]);
            if (looks_ != nullptr) add_looks(row, columns);
        }
        if (looks_ != nullptr) bring_to_unit(looks_->colours, element, columns);
    }

    void add_looks(const std::vector<double>& row, const PlyLookColumns& columns) {
        const auto add = [&](std::vector<float>& numbers, const auto& of, float missing) {
            if (of[0] == not_found) return;
            for (const int column : of)
                numbers.push_back(column == not_found ? missing : finite_float(row[static_cast<std::size_t>(column)]));
        };
        add(looks_->normals, columns.normal, 0.0F);
        add(looks_->colours, columns.colour, std::numeric_limits<float>::infinity()); // opaque, whatever the range
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
    PlyFile* looks_;       ///< null: not wanted
};

std::size_t vertex_count(const PlyHeader& header) {
    std::size_t count = 0;
    for (const PlyElement& element : header.elements)
        if (element.name == "vertex") count += static_cast<std::size_t>(element.count);
    return count;
}

} // namespace

namespace {

PolygonMesh parse(std::string_view bytes, PlyFile* looks) {
    TextScanner scanner(bytes);
    const PlyHeader header = parse_ply_header(scanner);
    const std::size_t vertices = vertex_count(header);
    if (looks != nullptr) looks->texture_file = header.texture_file;
    if (header.encoding == PlyEncoding::text) return PlyBody(TextSource(scanner), vertices, looks).parse(header);

    const std::string_view body = bytes.substr(bytes.size() - scanner.bytes_left());
    const auto order = header.encoding == PlyEncoding::little_endian ? std::endian::little : std::endian::big;
    return PlyBody(BinarySource(BinaryReader(body, order)), vertices, looks).parse(header);
}

} // namespace

PolygonMesh parse_ply(std::string_view bytes) { return parse(bytes, nullptr); }

PlyFile parse_ply_file(std::string_view bytes) {
    PlyFile file;
    file.mesh = parse(bytes, &file);
    return file;
}

} // namespace skelgen::io::detail
