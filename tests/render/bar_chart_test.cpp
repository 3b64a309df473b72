#include <skelgen/render/bar_chart.hpp>

#include <skelgen/core/error.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::render;

namespace {

/// Pixels that are plainly blue: bars.
int blue_pixels(const Image& image) {
    int count = 0;
    for (const Pixel& pixel : image.pixels) count += pixel[2] > 200 && pixel[0] < 100;
    return count;
}

} // namespace

TEST_CASE("bars are as high as their shares") {
    BarChart chart;
    chart.title = "chart", chart.across = "x", chart.upwards = "y";
    const int empty = blue_pixels(draw_bar_chart(chart, 400, 300));
    CHECK(empty == 0);
    chart.bars = {{0, 0.5, 0.5, ""}};
    const int half = blue_pixels(draw_bar_chart(chart, 400, 300));
    chart.bars = {{0, 0.5, 1, ""}};
    const Image image = draw_bar_chart(chart, 400, 300);
    CHECK(image.width == 400);
    CHECK(image.height == 300);
    CHECK(half > 0);
    CHECK(blue_pixels(image) == Approx(2 * half).epsilon(0.05));
}

TEST_CASE("what is above one ends at the top of the chart") {
    BarChart chart;
    chart.bars = {{0, 1, 1, ""}};
    const int full = blue_pixels(draw_bar_chart(chart, 200, 200));
    chart.bars = {{0, 1, 7, ""}};
    CHECK(blue_pixels(draw_bar_chart(chart, 200, 200)) == full);
}

TEST_CASE("a chart that is too small to be read is refused") {
    try {
        (void)draw_bar_chart({}, 50, 400);
        FAIL("accepted");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
    }
}
