#include "mesh_parsers.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "binary_reader.hpp"
#include "text_scanner.hpp"
#include "vertex_merger.hpp"

namespace skelgen::io::detail {
namespace {

constexpr std::size_t header_bytes = 80, count_bytes = 4, facet_bytes = 50;

std::uint32_t facet_count(std::string_view bytes) {
    return BinaryReader(bytes.substr(header_bytes), std::endian::little).read<std::uint32_t>();
}

bool equal_ignoring_case(std::string_view word, std::string_view lower) {
    return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                      [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

class StlTextParser {
public:
    explicit StlTextParser(std::string_view text) : scanner_(text) {}

    PolygonMesh parse() {
        while (scanner_.seek_word()) read_statement(scanner_.word());
        if (!solid_ended_) scanner_.fail("the file ends without endsolid: it is cut short");
        return std::move(mesh_);
    }

private:
    void read_statement(std::string_view word) {
        const auto is = [word](std::string_view keyword) { return equal_ignoring_case(word, keyword); };
        if (is("vertex")) {
            read_vertex();
        } else if (is("endfacet")) {
            end_facet();
        } else if (is("facet")) {
            if (corners_ != 0) scanner_.fail("a facet begins before the last one ended");
            skip_normal();
        } else if (is("solid") || is("endsolid")) {
            solid_ended_ = is("endsolid");
            if (corners_ != 0) scanner_.fail("a solid begins or ends within a facet");
            scanner_.skip_line(); // its name
        } else if (!is("outer") && !is("loop") && !is("endloop")) {
            scanner_.fail("'facet', 'vertex' or another word of STL was expected");
        }
    }

    void read_vertex() {
        if (++corners_ > 3) scanner_.fail("a facet has more than 3 vertices");
        merger_.add_corner(scanner_.coordinates());
    }

    void end_facet() {
        if (corners_ != 3) scanner_.fail("a facet has " + std::to_string(corners_) + " vertices; it must have 3");
        mesh_.sizes.push_back(3);
        corners_ = 0;
    }

    /// The normal says nothing that the corners do not, and is often wrong or no number.
    void skip_normal() {
        while (!scanner_.at_line_end() && !equal_ignoring_case(scanner_.peek_word(), "outer"))
            static_cast<void>(scanner_.word());
    }

    TextScanner scanner_;
    PolygonMesh mesh_;
    VertexMerger merger_{mesh_};
    int corners_ = 0; ///< of the facet being read
    bool solid_ended_ = false;
};

double read_coordinate(BinaryReader& reader) {
    const auto value = reader.read<float>();
    if (!std::isfinite(value)) reader.fail("a coordinate is not a number or infinite");
    return static_cast<double>(value);
}

} // namespace

PolygonMesh parse_stl_text(std::string_view text) { return StlTextParser(text).parse(); }

PolygonMesh parse_stl_binary(std::string_view bytes) {
    BinaryReader reader(bytes, std::endian::little);
    reader.skip(header_bytes);
    const std::uint64_t facets = reader.read<std::uint32_t>();
    // A few stray bytes in the end are common; a facet too few or too many means that the count is wrong.
    if (reader.bytes_left() / facet_bytes != facets)
        reader.fail("the header promises " + std::to_string(facets) + " facets, but the file holds " +
                    std::to_string(reader.bytes_left() / facet_bytes));
    if (facets > static_cast<std::uint64_t>(std::numeric_limits<int>::max() / 3))
        reader.fail("there are too many facets");

    PolygonMesh mesh;
    mesh.sizes.assign(facets, 3);
    mesh.corners.reserve(3 * facets);
    VertexMerger merger(mesh, facets / 2); // closed surfaces have half as many vertices as facets
    for (std::uint64_t facet = 0; facet < facets; ++facet) {
        reader.skip(3 * sizeof(float)); // the normal
        for (int corner = 0; corner < 3; ++corner) {
            const double x = read_coordinate(reader);
            const double y = read_coordinate(reader);
            const double z = read_coordinate(reader);
            merger.add_corner({x, y, z});
        }
        reader.skip(sizeof(std::uint16_t)); // "attributes": colours of some programs
    }
    return mesh;
}

bool is_stl_binary(std::string_view bytes) {
    return bytes.size() >= header_bytes + count_bytes &&
           bytes.size() - header_bytes - count_bytes == std::uint64_t{facet_count(bytes)} * facet_bytes;
}

} // namespace skelgen::io::detail
