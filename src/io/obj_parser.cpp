#include "mesh_parsers.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "parser_checks.hpp"
#include "text_scanner.hpp"

namespace skelgen::io::detail {
namespace {

class ObjParser {
public:
    explicit ObjParser(std::string_view text) : scanner_(text) {}

    PolygonMesh parse() {
        while (scanner_.seek_word()) {
            const char* const row = scanner_.position();
            const std::string_view keyword = scanner_.word();
            if (keyword == "v")
                read_vertex();
            else if (keyword == "f")
                read_face(row);
            else
                scanner_.skip_line(); // normals, texture coordinates, groups, materials, lines, curves
        }
        check_forward_references();
        return std::move(mesh_);
    }

private:
    void read_vertex() {
        for (const double coordinate : scanner_.coordinates()) mesh_.coordinates.push_back(coordinate);
        scanner_.skip_line(); // weight, colour
    }

    void read_face(const char* row) {
        const std::size_t first = mesh_.corners.size();
        while (!scanner_.at_line_end()) {
            mesh_.corners.push_back(read_corner(row));
            if (!scanner_.at_word_end() && !scanner_.take('/'))
                scanner_.fail("a face's corner is not of the form v/vt/vn");
            scanner_.skip_rest_of_word(); // texture coordinate, normal
        }
        mesh_.sizes.push_back(checked_size(scanner_, static_cast<std::int64_t>(mesh_.corners.size() - first)));
    }

    /// An index counted from 1, or backwards from the vertex read last.
    int read_corner(const char* row) {
        const std::int64_t written = scanner_.integer("vertex index");
        const auto vertices = static_cast<std::int64_t>(mesh_.coordinates.size() / 3);
        const std::int64_t index = written < 0 ? vertices + written : written - 1;
        if (written == 0 || index < 0 || index > std::numeric_limits<int>::max())
            scanner_.fail("a face names vertex " + std::to_string(written) +
                          ", but indices count from 1 and there are " + std::to_string(vertices) + " vertices so far");
        if (index >= vertices && index > highest_forward_) {
            highest_forward_ = index;
            forward_row_ = row;
        }
        return static_cast<int>(index);
    }

    /// A face may name vertices that follow it; whether they did is known in the end.
    void check_forward_references() const {
        const std::size_t vertices = mesh_.coordinates.size() / 3;
        if (highest_forward_ >= static_cast<std::int64_t>(vertices))
            scanner_.fail_at(forward_row_, "a face names vertex " + std::to_string(highest_forward_ + 1) +
                                               ", but there are " + std::to_string(vertices) + " vertices");
    }

    TextScanner scanner_;
    PolygonMesh mesh_;
    std::int64_t highest_forward_ = -1; ///< highest index that was named before its vertex came
    const char* forward_row_ = nullptr; ///< the row that named it
};

} // namespace

bool is_obj_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 11> keywords{"v", "vn",     "vt",     "vp", "f", "o",
                                                        "g", "mtllib", "usemtl", "s",  "l"};
    return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

PolygonMesh parse_obj(std::string_view text) { return ObjParser(text).parse(); }

} // namespace skelgen::io::detail
