#include "catch.hpp"

#include <png.h>

#include <sstream>

#include <boost/property_tree/xml_parser.hpp>

#include <render/stroke_font.hpp>
#include <render/xml_text.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/render/contact_sheet.hpp>
#include <skelgen/render/png.hpp>

using namespace skelgen;
using namespace skelgen::render;

namespace {

Image gradient(int width, int height) {
    Image image(width, height, {0, 0, 0, 0});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), 7,
                              static_cast<std::uint8_t>(255 - x - y)};
    return image;
}

Image decoded(const std::string& bytes) {
    png_image header = {};
    header.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) != 0);
    header.format = PNG_FORMAT_RGBA;
    Image image(static_cast<int>(header.width), static_cast<int>(header.height), {0, 0, 0, 0});
    REQUIRE(png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr) != 0);
    return image;
}

} // namespace

TEST_CASE("a PNG reads back as the picture it was") {
    const Image image = gradient(37, 21);
    const std::string bytes = encode_png(image);
    CHECK(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    const Image back = decoded(bytes);
    CHECK(back.width == 37);
    CHECK(back.height == 21);
    CHECK(back.pixels == image.pixels);
    CHECK(encode_png(image) == bytes);
}

TEST_CASE("a picture without pixels is no PNG") { CHECK_THROWS_AS(encode_png(Image()), Error); }

TEST_CASE("a contact sheet holds its pictures row by row") {
    std::vector<Image> cells;
    for (std::uint8_t i = 0; i < 5; ++i) cells.emplace_back(4, 3, Pixel{i, 0, 0, 255});
    const Image sheet = contact_sheet(cells, 2);
    CHECK(sheet.width == 8);
    CHECK(sheet.height == 9);
    for (int i = 0; i < 5; ++i) CHECK(sheet.at(i % 2 * 4 + 1, i / 2 * 3 + 1)[0] == i);
    CHECK(sheet.at(7, 8) == cells.front().at(0, 0)); // the cell that is left over
    CHECK(contact_sheet(cells, 9).width == 20);
}

TEST_CASE("a contact sheet needs pictures of one size and a column") {
    CHECK_THROWS_AS(contact_sheet({}, 1), Error);
    CHECK_THROWS_AS(contact_sheet({gradient(4, 4)}, 0), Error);
    CHECK_THROWS_AS(contact_sheet({gradient(4, 4), gradient(4, 5)}, 1), Error);
    CHECK_THROWS_AS(svg_contact_sheet({}, 1, 4, 4), Error);
}

TEST_CASE("a sheet is as square as it gets") {
    CHECK(sheet_columns(1, 100, 100) == 1);
    CHECK(sheet_columns(9, 100, 100) == 3);
    CHECK(sheet_columns(10, 100, 100) == 4);
    CHECK(sheet_columns(3, 10, 1000) == 3);
    CHECK(sheet_columns(8, 200, 100) == 2);
}

TEST_CASE("an SVG contact sheet moves each document to its place") {
    const std::string cell = "<svg xmlns=\"http://www.w3.org/2000/svg\"/>\n";
    std::istringstream stream(svg_contact_sheet({cell, cell, cell}, 2, 30, 40));
    boost::property_tree::ptree document;
    boost::property_tree::read_xml(stream, document);
    CHECK(document.get<int>("svg.<xmlattr>.width") == 60);
    CHECK(document.get<int>("svg.<xmlattr>.height") == 80);
    std::vector<std::string> moves;
    for (const auto& [tag, element] : document.get_child("svg"))
        if (tag == "g") moves.push_back(element.get<std::string>("<xmlattr>.transform"));
    CHECK(moves == std::vector<std::string>{"translate(0 0)", "translate(30 0)", "translate(0 40)"});
}

TEST_CASE("every letter has strokes that stay within its width") {
    const double cap_height = 14; // two pixels per unit of the font's grid
    for (char c = '!'; c <= '~'; ++c) {
        const std::string letter(1, c);
        INFO(letter);
        const auto strokes = render::text_strokes(letter, {0, 0}, cap_height);
        CHECK_FALSE(strokes.empty());
        for (const auto& stroke : strokes) {
            CHECK_FALSE(stroke.empty());
            for (const Eigen::Vector2d& p : stroke) {
                CHECK(p.x() >= 0);
                CHECK(p.x() <= render::text_width(letter, cap_height));
                CHECK(p.y() <= 2 * cap_height / 7); // descender
                CHECK(p.y() >= -cap_height);
            }
        }
    }
    CHECK(render::text_strokes(" ", {0, 0}, cap_height).empty());
}

TEST_CASE("letters outside ASCII are one box each, whatever their bytes") {
    CHECK(render::text_strokes("\xC3\xA9\xE2\x82\xAC", {0, 0}, 7).size() == 2);
    CHECK(render::text_width("\xC3\xA9", 7) == render::text_width("\xE2\x82\xAC", 7));
    CHECK(render::text_width("ab", 7) == Approx(render::text_width("a", 7) + render::text_width("b", 7) + 2));
}

TEST_CASE("text in XML is escaped, and what XML cannot hold replaced") {
    CHECK(render::xml_text("a<b>&\"c\"") == "a&lt;b&gt;&amp;&quot;c&quot;");
    CHECK(render::xml_text("\xC3\xA9\xF0\x9F\xA6\xB4") == "\xC3\xA9\xF0\x9F\xA6\xB4");
    CHECK(render::xml_text("a\nb\x7F") == "a?b?");
    CHECK(render::xml_text("\xC3(\xFF\xED\xA0\x80\xC0\x80\xE2\x82") == "?(??"
                                                                       "????"
                                                                       "??");
}

TEST_CASE("numbers are short and the same everywhere") {
    CHECK(render::decimal(1) == "1");
    CHECK(render::decimal(-0.001) == "0");
    CHECK(render::decimal(12.3456) == "12.35");
}
