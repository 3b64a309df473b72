#include <skelgen/render/contact_sheet.hpp>

#include <algorithm>
#include <cmath>

#include <skelgen/core/error.hpp>

namespace skelgen::render {
namespace {

void check_sheet(std::size_t cells, int columns) {
    if (cells == 0) throw Error(ErrorCode::usage, "a contact sheet needs at least one picture");
    if (columns < 1) throw Error(ErrorCode::usage, "a contact sheet needs at least one column");
}

struct Grid {
    int columns;
    int rows;
};

Grid grid_of(std::size_t cells, int columns) {
    const int count = static_cast<int>(cells);
    const int used = std::min(columns, count);
    return {used, (count + used - 1) / used};
}

void copy_into(const Image& cell, int left, int top, Image& sheet) {
    for (int y = 0; y < cell.height; ++y) std::copy_n(&cell.at(0, y), cell.width, &sheet.at(left, top + y));
}

} // namespace

int sheet_columns(int cells, int cell_width, int cell_height) {
    const double square = std::sqrt(double(cells) * cell_height / cell_width);
    return std::clamp(static_cast<int>(std::ceil(square)), 1, std::max(cells, 1));
}

Image contact_sheet(const std::vector<Image>& cells, int columns) {
    check_sheet(cells.size(), columns);
    const Grid grid = grid_of(cells.size(), columns);
    const int width = cells.front().width;
    const int height = cells.front().height;
    // Empty cells of the last row take the background of the first picture's corner.
    Image sheet(width * grid.columns, height * grid.rows, cells.front().at(0, 0));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].width != width || cells[i].height != height)
            throw Error(ErrorCode::usage, "the pictures of a contact sheet must have the same size");
        copy_into(cells[i], static_cast<int>(i) % grid.columns * width, static_cast<int>(i) / grid.columns * height,
                  sheet);
    }
    return sheet;
}

std::string svg_contact_sheet(const std::vector<std::string>& cells, int columns, int cell_width, int cell_height) {
    check_sheet(cells.size(), columns);
    const Grid grid = grid_of(cells.size(), columns);
    std::string sheet = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                        std::to_string(cell_width * grid.columns) + "\" height=\"" +
                        std::to_string(cell_height * grid.rows) + "\">\n";
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int x = static_cast<int>(i) % grid.columns * cell_width;
        const int y = static_cast<int>(i) / grid.columns * cell_height;
        sheet +=
            "<g transform=\"translate(" + std::to_string(x) + " " + std::to_string(y) + ")\">\n" + cells[i] + "</g>\n";
    }
    return sheet + "</svg>\n";
}

} // namespace skelgen::render
