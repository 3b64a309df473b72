#include <skelgen/io/curve_formats.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>

#include "curve_builder.hpp"
#include "curve_checks.hpp"
#include "number_text.hpp"
#include "parser_checks.hpp"
#include "ply_source.hpp"

namespace skelgen::io {
namespace {

using detail::append_number;
using detail::PlyElement;
using detail::PlyHeader;
using detail::PlyProperty;

/// Fills a curve skeleton from a body whose values come from `Source`.
template <typename Scalar, typename Source>
class CurvePlyBody {
public:
    CurvePlyBody(Source source, std::size_t nodes) : source_(std::move(source)), nodes_(nodes) {}

    CurveSkeleton<Scalar> parse(const PlyHeader& header) {
        for (const PlyElement& element : header.elements) {
            if (element.count == 0) continue;
            if (element.name == "face" || element.name == "tristrips")
                source_.fail("the header promises faces: this is a mesh, no curve skeleton");
            const bool is_node = element.name == "vertex", is_edge = element.name == "edge";
            if (element.properties.empty() && !is_node && !is_edge) continue; // rows of nothing
            const std::size_t least_bytes = std::max<std::size_t>(1, detail::least_row_bytes<Source>(element));
            const std::size_t count = detail::checked_count(source_, element.count, least_bytes, "rows of an element");
            if (is_node)
                read_nodes(element, count);
            else if (is_edge)
                read_edges(element, count);
            else
                detail::skip_rows(source_, element, count);
        }
        source_.end();
        return builder_.finish(fail());
    }

private:
    static constexpr int skipped = -1;

    [[nodiscard]] auto fail() const {
        return [this](const std::string& message) { source_.fail(message); };
    }

    /// Per property of an element which of `names` it is, or `skipped`.
    template <std::size_t n>
    [[nodiscard]] std::vector<int> columns(const PlyElement& element, const std::array<const char*, n>& names) const {
        std::vector<int> columns(element.properties.size(), skipped);
        for (std::size_t name = 0; name < n; ++name) {
            const int found = detail::find_property(element, names[name]);
            if (found == detail::not_found || element.properties[static_cast<std::size_t>(found)].length_type)
                source_.fail("the element '" + element.name + "' lacks a property " + names[name]);
            columns[static_cast<std::size_t>(found)] = static_cast<int>(name);
        }
        return columns;
    }

    /// One row's values, each at its place; what `places` has skipped is passed over.
    template <typename Row, typename Read>
    Row read_row(const PlyElement& element, const std::vector<int>& places, const Read& read) {
        Row row{};
        source_.begin_row();
        for (std::size_t k = 0; k < places.size(); ++k) {
            const PlyProperty& property = element.properties[k];
            if (places[k] == skipped)
                detail::skip_value(source_, property);
            else
                row[static_cast<std::size_t>(places[k])] = read(property);
        }
        source_.end_row();
        return row;
    }

    void read_nodes(const PlyElement& element, std::size_t count) {
        const bool has_radius = detail::find_property(element, "radius") != detail::not_found;
        const std::vector<int> places =
            has_radius ? columns<4>(element, {"x", "y", "z", "radius"}) : columns<3>(element, {"x", "y", "z"});
        for (std::size_t i = 0; i < count; ++i) {
            const auto row = read_row<std::array<Scalar, 4>>(
                element, places, [this](const PlyProperty& property) { return finite(property); });
            builder_.add_node({row[0], row[1], row[2]}, fail());
            if (has_radius) builder_.add_radius(row[3], fail());
        }
    }

    Scalar finite(const PlyProperty& property) {
        const auto value = source_.template number<Scalar>(property.type);
        if (!std::isfinite(value)) source_.fail("a coordinate or radius is not a number or infinite");
        return value;
    }

    void read_edges(const PlyElement& element, std::size_t count) {
        const std::vector<int> places = columns<2>(element, {"vertex1", "vertex2"});
        for (std::size_t k = 0; k < places.size(); ++k)
            if (places[k] != skipped && !detail::is_integer(element.properties[k].type))
                source_.fail("the properties vertex1 and vertex2 must be of an integer type");
        for (std::size_t i = 0; i < count; ++i) {
            const auto edge = read_row<std::array<std::int64_t, 2>>(
                element, places, [this](const PlyProperty& property) { return source_.integer(property.type); });
            builder_.add_edge(edge[0], edge[1], nodes_, fail());
        }
    }

    Source source_;
    std::size_t nodes_; ///< how many the header promises: edges may come before them
    detail::CurveBuilder<Scalar> builder_{0};
};

std::size_t node_count(const detail::TextScanner& scanner, const PlyHeader& header) {
    std::size_t count = 0;
    int elements = 0;
    for (const PlyElement& element : header.elements) {
        if (element.name != "vertex") continue;
        count = static_cast<std::size_t>(element.count);
        if (++elements > 1) scanner.fail("the header has two elements 'vertex'");
    }
    return count;
}

} // namespace

template <typename Scalar>
std::string curve_to_ply(const CurveSkeleton<Scalar>& curve) {
    detail::check_curve(curve, ErrorCode::usage);
    const std::string type = std::is_same_v<Scalar, float> ? "float" : "double";
    std::string text = "ply\nformat ascii 1.0\ncomment skelgen curve skeleton\nelement vertex ";
    append_number(text, curve.nodes.rows());
    for (const char* axis : {"x", "y", "z"}) text += "\nproperty " + type + " " + axis;
    if (!curve.radii.empty()) text += "\nproperty " + type + " radius";
    text += "\nelement edge ";
    append_number(text, curve.edges.size());
    text += "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
    for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i) {
        detail::append_point(text, curve.nodes.row(i));
        if (!curve.radii.empty()) {
            text += ' ';
            append_number(text, curve.radii[static_cast<std::size_t>(i)]);
        }
        text += '\n';
    }
    for (const auto& [a, b] : curve.edges) {
        append_number(text, a);
        text += ' ';
        append_number(text, b);
        text += '\n';
    }
    return text;
}

template <typename Scalar>
CurveSkeleton<Scalar> curve_from_ply(std::string_view bytes) {
    detail::TextScanner scanner(bytes, "curve");
    const PlyHeader header = detail::parse_ply_header(scanner);
    const std::size_t nodes = node_count(scanner, header);
    if (header.encoding == detail::PlyEncoding::text)
        return CurvePlyBody<Scalar, detail::TextSource>(detail::TextSource(scanner), nodes).parse(header);

    const std::string_view body = bytes.substr(bytes.size() - scanner.bytes_left());
    const auto order = header.encoding == detail::PlyEncoding::little_endian ? std::endian::little : std::endian::big;
    const detail::BinarySource source(detail::BinaryReader(body, order, "curve"));
    return CurvePlyBody<Scalar, detail::BinarySource>(source, nodes).parse(header);
}

template std::string curve_to_ply<float>(const CurveSkeleton<float>&);
template std::string curve_to_ply<double>(const CurveSkeleton<double>&);
template CurveSkeleton<float> curve_from_ply<float>(std::string_view);
template CurveSkeleton<double> curve_from_ply<double>(std::string_view);

} // namespace skelgen::io
