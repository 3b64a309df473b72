#include "stroke_font.hpp"

#include <algorithm>
#include <array>

namespace skelgen::render {
namespace {

// Glyphs on a grid of 7 units cap height. A point is two digits, x and y; y is 0 at the descender, 2 at the baseline,
// 7 at the top of small letters, 9 at the top of capitals. A point after '~' is the control point of a parabola, two
// of them in a row meet half-way (as in TrueType outlines). A blank lifts the pen, a single point is a dot.
constexpr std::array<std::string_view, 95> glyphs = {
    "",                                       // space
    "0905 0202",                              // !
    "0907 2927",                              // "
    "1218 3238 0444 0646",                    // #
    "48~49~09~06~45~42~0203 2129",            // $
    "19~29~27~07~0919 54~64~62~42~4454 1259", // %
    "5217~0929~49~37~05~0222~4255",           // &
    "0907",                                   // '
    "29~07~0321",                             // (
    "09~27~2301",                             // )
    "2925 0846 4806",                         // *
    "2327 0545",                              // +
    "1201",                                   // ,
    "0535",                                   // -
    "0202",                                   // .
    "0149",                                   // /
    "22~42~49~09~0222",                       // 0
    "072922",                                 // 1
    "07~09~49~460242",                        // 2
    "08~09~49~4626 26~46~42~0203",            // 3
    "32390444",                               // 4
    "49090626~46~42~0203",                    // 5
    "48~49~09~02~42~46~0604",                 // 6
    "094912",                                 // 7
    "26~46~49~09~0626 26~46~42~02~0626",      // 8
    "03~02~42~49~09~05~4547",                 // 9
    "0202 0606",                              // :
    "1201 1616",                              // ;
    "380532",                                 // <
    "0444 0646",                              // =
    "083502",                                 // >
    "07~09~49~46~2624 2222",                  // ?
    "52~02~09~69~64~4447 46~47~27~24~4446",   // @
    "023962 1454",                            // A
    "020929~49~462606 26~56~522202",          // B
    "57~59~09~02~5254",                       // C
    "020929~59~522202",                       // D
    "49090242 0636",                          // E
    "490902 0636",                            // F
    "57~59~09~02~525535",                     // G
    "0209 5259 0656",                         // H
    "0209",                                   // I
    "3934~32~0204",                           // J
    "0209 5904 2652",                         // K
    "090242",                                 // L
    "0209346962",                             // M
    "02095259",                               // N
    "32~62~69~09~0232",                       // O
    "020929~59~552505",                       // P
    "32~62~69~09~0232 4461",                  // Q
    "020929~59~552505 2552",                  // R
    "58~59~09~06~55~52~0203",                 // S
    "0969 3932",                              // T
    "0904~02~525459",                         // U
    "093269",                                 // V
    "0922486289",                             // W
    "0259 5209",                              // X
    "093569 3532",                            // Y
    "09590252",                               // Z
    "29090121",                               // [
    "0941",                                   // backslash
    "09292101",                               // ]
    "062946",                                 // ^
    "0141",                                   // _
    "0918",                                   // `
    "4742 22~42~47~07~0222",                  // a
    "0902 22~42~47~07~0222",                  // b
    "46~47~07~02~4243",                       // c
    "4942 22~42~47~07~0222",                  // d
    "0545~47~07~02~4243",                     // e
    "39~191712 0737",                         // f
    "4741~40~0001 22~42~47~07~0222",          // g
    "0902 05~07~474542",                      // h
    "0702 0909",                              // i
    "1711~1000 1919",                         // j
    "0902 3704 1542",                         // k
    "0902",                                   // l
    "0702 05~07~373532 35~37~676562",         // m
    "0702 05~07~474542",                      // n
    "22~42~47~07~0222",                       // o
    "0700 22~42~47~07~0222",                  // p
    "4740 22~42~47~07~0222",                  // q
    "0702 05~07~3736",                        // r
    "36~37~07~05~34~32~0203",                 // s
    "1914~1232 0737",                         // t
    "0704~02~4244 4742",                      // u
    "072247",                                 // v
    "0712365267",                             // w
    "0742 0247",                              // x
    "0722 472210",                            // y
    "07470242",                               // z
    "39~1917~1505~1513~1131",                 // {
    "0901",                                   // |
    "09~2927~2535~2523~2101",                 // }
    "05~17~3345",                             // ~
};
constexpr std::string_view box = "0209494202";
constexpr double cap_units = 7;
constexpr double baseline_units = 2;
constexpr double space_units = 3;
constexpr double gap_units = 2; // between letters
constexpr int curve_steps = 6;

bool continues_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string_view glyph_of(char c) { return c >= ' ' && c <= '~' ? glyphs[static_cast<std::size_t>(c - ' ')] : box; }

double advance(std::string_view glyph) {
    if (glyph.empty()) return space_units;
    double width = 0;
    for (std::size_t i = 0; i < glyph.size();) {
        if (glyph[i] == ' ' || glyph[i] == '~') {
            ++i;
            continue;
        }
        width = std::max(width, double(glyph[i] - '0'));
        i += 2;
    }
    return width + gap_units;
}

void add_parabola(const Eigen::Vector2d& control, const Eigen::Vector2d& end, Polyline& line) {
    const Eigen::Vector2d start = line.back();
    for (int i = 1; i <= curve_steps; ++i) {
        const double t = double(i) / curve_steps;
        line.push_back((1 - t) * (1 - t) * start + 2 * t * (1 - t) * control + t * t * end);
    }
}

/// One stroke of a glyph, in grid units.
Polyline flatten(std::string_view stroke) {
    Polyline line;
    bool has_control = false;
    Eigen::Vector2d control = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i + 1 < stroke.size(); i += 2) {
        const bool is_control = stroke[i] == '~';
        if (is_control) ++i;
        const Eigen::Vector2d point(stroke[i] - '0', stroke[i + 1] - '0');
        if (has_control)
            add_parabola(control, is_control ? Eigen::Vector2d((control + point) / 2) : point, line);
        else if (!is_control)
            line.push_back(point);
        control = point;
        has_control = is_control;
    }
    return line;
}

void add_glyph(std::string_view glyph, const Eigen::Vector2d& pen, double unit, std::vector<Polyline>& strokes) {
    while (!glyph.empty()) {
        const std::size_t end = std::min(glyph.find(' '), glyph.size());
        Polyline line = flatten(glyph.substr(0, end));
        for (Eigen::Vector2d& p : line) p = pen + unit * Eigen::Vector2d(p.x(), baseline_units - p.y());
        strokes.push_back(std::move(line));
        glyph.remove_prefix(std::min(end + 1, glyph.size()));
    }
}

} // namespace

double text_width(std::string_view text, double cap_height) {
    double units = 0;
    for (const char c : text)
        if (!continues_code_point(c)) units += advance(glyph_of(c));
    return std::max(0.0, units - gap_units) * cap_height / cap_units;
}

std::vector<Polyline> text_strokes(std::string_view text, const Eigen::Vector2d& baseline, double cap_height) {
    const double unit = cap_height / cap_units;
    std::vector<Polyline> strokes;
    Eigen::Vector2d pen = baseline;
    for (const char c : text) {
        if (continues_code_point(c)) continue;
        add_glyph(glyph_of(c), pen, unit, strokes);
        pen.x() += unit * advance(glyph_of(c));
    }
    return strokes;
}

} // namespace skelgen::render
