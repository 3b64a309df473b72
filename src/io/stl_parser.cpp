#include "mesh_parsers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "binary_reader.hpp"
#include "text_scanner.hpp"

namespace skelgen::io::detail {
namespace {

constexpr std::size_t header_bytes = 80, count_bytes = 4, facet_bytes = 50;

std::uint32_t facet_count(std::string_view bytes) {
    return BinaryReader(bytes.substr(header_bytes), std::endian::little).read<std::uint32_t>();
}

/// Gives every position one index: a hash table with linear probing, a fraction of the time and memory that
/// std::unordered_map takes for millions of corners.
class VertexMerger {
public:
    explicit VertexMerger(PolygonMesh& mesh, std::size_t expected_vertices = 0)
        : mesh_(mesh), slots_(std::bit_ceil(std::max<std::size_t>(2 * expected_vertices + 1, 1024)), empty) {}

    void add_corner(std::array<double, 3> position) {
        for (double& coordinate : position) coordinate += 0.0; // -0 becomes 0
        if (2 * (mesh_.coordinates.size() / 3) >= slots_.size()) grow();
        int& slot = find(position.data());
        if (slot == empty) {
            slot = static_cast<int>(mesh_.coordinates.size() / 3);
            mesh_.coordinates.insert(mesh_.coordinates.end(), position.begin(), position.end());
        }
        mesh_.corners.push_back(slot);
    }

private:
    static constexpr int empty = -1;

    [[nodiscard]] const double* position(int vertex) const {
        return &mesh_.coordinates[3 * static_cast<std::size_t>(vertex)];
    }

    [[nodiscard]] static std::uint64_t hash(const double* p) {
        std::uint64_t h = 0;
        for (int axis = 0; axis < 3; ++axis) {
            h = (h ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9e3779b97f4a7c15U; // 2^64 / golden ratio
            h ^= h >> 32U;
        }
        return h;
    }

    /// The slot that holds this position, or the empty one where it belongs. Slots are a power of two in number.
    [[nodiscard]] int& find(const double* p) {
        const std::uint64_t mask = slots_.size() - 1;
        for (std::uint64_t i = hash(p) & mask;; i = (i + 1) & mask) {
            int& slot = slots_[i];
            if (slot == empty || std::equal(p, p + 3, position(slot))) return slot;
        }
    }

    void grow() {
        slots_.assign(4 * slots_.size(), empty);
        const int vertices = static_cast<int>(mesh_.coordinates.size() / 3);
        for (int vertex = 0; vertex < vertices; ++vertex) find(position(vertex)) = vertex;
    }

    PolygonMesh& mesh_;
    std::vector<int> slots_; ///< vertex indices or `empty`, at most half full
};

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
