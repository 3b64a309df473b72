#include "obj_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "finite_float.hpp"
#include "mesh_parsers.hpp"
#include "parser_checks.hpp"
#include "text_scanner.hpp"

namespace skelgen::io::detail {
namespace {

class ObjParser {
public:
    /// `with_looks`: reads more than the shape.
    ObjParser(std::string_view text, bool with_looks) : scanner_(text), with_looks_(with_looks) {}

    ObjFile parse() {
        while (scanner_.seek_word()) {
            const char* const row = scanner_.position();
            const std::string_view keyword = scanner_.word();
            if (keyword == "v")
                read_vertex();
            else if (keyword == "f")
                read_face(row);
            else if (with_looks_)
                read_looks(keyword);
            else
                scanner_.skip_continued_line(); // normals, texture coordinates, groups, materials, lines, curves
        }
        check_forward_references();
        for (ObjCorner& corner : file_.corners) { // faces may come before what they name
            if (corner.texture >= static_cast<int>(file_.texture_coordinates.size() / 2)) corner.texture = -1;
            if (corner.normal >= static_cast<int>(file_.normals.size() / 3)) corner.normal = -1;
        }
        return std::move(file_);
    }

private:
    void read_vertex() {
        for (const double coordinate : scanner_.coordinates()) mesh_.coordinates.push_back(coordinate);
        if (with_looks_) read_colour();
        scanner_.skip_continued_line(); // weight, colour
    }

    /// Red, green and blue, and perhaps alpha; one number alone is a weight.
    void read_colour() {
        std::array<float, 4> colour{1, 1, 1, 1};
        std::size_t channels = 0;
        for (; channels < colour.size() && !scanner_.at_line_end(); ++channels)
            colour[channels] = finite_float(scanner_.try_number().value_or(1));
        if (channels < 3 && file_.colours.empty()) return;
        file_.colours.resize(4 * (mesh_.coordinates.size() / 3 - 1), 1.0F); // of those before that have none
        if (channels < 3) colour.fill(1);
        file_.colours.insert(file_.colours.end(), colour.begin(), colour.end());
    }

    void read_numbers(std::vector<float>& numbers, int count) {
        bool is_sound = true;
        for (int i = 0; i < count; ++i) {
            const auto value = scanner_.at_line_end() ? std::nullopt : scanner_.try_number();
            is_sound = is_sound && value;
            numbers.push_back(finite_float(value.value_or(0)));
        }
        if (!is_sound && count == 3) std::fill(numbers.end() - count, numbers.end(), 0.0F);
    }

    void read_looks(std::string_view keyword) {
        if (keyword == "vt")
            read_numbers(file_.texture_coordinates, 2);
        else if (keyword == "vn")
            read_numbers(file_.normals, 3);
        else if (keyword == "mtllib")
            file_.libraries.emplace_back(scanner_.peek_rest_of_line());
        else if (keyword == "usemtl")
            use_material(std::string(scanner_.peek_rest_of_line()));
        scanner_.skip_continued_line();
    }

    void use_material(const std::string& name) {
        const auto [known, is_new] = materials_.emplace(name, static_cast<int>(file_.materials.size()));
        if (is_new) file_.materials.push_back(name);
        material_ = known->second;
    }

    void read_face(const char* row) {
        const std::size_t first = mesh_.corners.size();
        while (!scanner_.at_line_end()) {
            mesh_.corners.push_back(read_corner(row));
            const bool ends = scanner_.at_word_end();
            if (!ends && !scanner_.take('/')) scanner_.fail("a face's corner is not of the form v/vt/vn");
            if (with_looks_) file_.corners.push_back(ends ? ObjCorner{} : read_corner_looks());
            scanner_.skip_rest_of_word(); // texture coordinate, normal
        }
        if (with_looks_) file_.face_materials.push_back(material_);
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

    /// What is behind the vertex' slash.
    ObjCorner read_corner_looks() {
        ObjCorner corner;
        corner.texture = read_index(file_.texture_coordinates.size() / 2);
        if (scanner_.take('/')) corner.normal = read_index(file_.normals.size() / 3);
        return corner;
    }

    /// An index of which there have been `count` so far; -1 where there is none, or none that can be.
    int read_index(std::size_t count) {
        const auto written = scanner_.try_integer();
        if (!written || *written == 0 || *written > std::numeric_limits<int>::max()) return -1;
        if (*written > 0) return static_cast<int>(*written - 1);
        return static_cast<int>(std::max<std::int64_t>(static_cast<std::int64_t>(count) + *written, -1));
    }

    /// A face may name vertices that follow it; whether they did is known in the end.
    void check_forward_references() const {
        const std::size_t vertices = mesh_.coordinates.size() / 3;
        if (highest_forward_ >= static_cast<std::int64_t>(vertices))
            scanner_.fail_at(forward_row_, "a face names vertex " + std::to_string(highest_forward_ + 1) +
                                               ", but there are " + std::to_string(vertices) + " vertices");
    }

    TextScanner scanner_;
    bool with_looks_;
    ObjFile file_;
    PolygonMesh& mesh_ = file_.mesh;
    std::map<std::string, int> materials_; ///< by name
    int material_ = -1;                    ///< that of the faces to come
    std::int64_t highest_forward_ = -1;    ///< highest index that was named before its vertex came
    const char* forward_row_ = nullptr;    ///< the row that named it
};

} // namespace

bool is_obj_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 11> keywords{"v", "vn",     "vt",     "vp", "f", "o",
                                                        "g", "mtllib", "usemtl", "s",  "l"};
    return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

PolygonMesh parse_obj(std::string_view text) { return ObjParser(text, false).parse().mesh; }

ObjFile parse_obj_file(std::string_view text) {
    ObjFile file = ObjParser(text, true).parse();
    if (!file.colours.empty()) file.colours.resize(file.mesh.coordinates.size() / 3 * 4, 1.0F);
    return file;
}

} // namespace skelgen::io::detail
