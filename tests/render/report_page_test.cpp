#include <string>
#include <vector>

#include <skelgen/render/report_page.hpp>

#include "catch.hpp"

namespace {

using skelgen::render::report_page;
using skelgen::render::ReportEntry;

ReportEntry entry(const std::string& file, const std::string& status = "ok") {
    ReportEntry out;
    out.file = file;
    out.status = status;
    return out;
}

/// Where a mesh's heading stands on the page.
std::size_t place(const std::string& page, const std::string& file) {
    const auto at = page.find("<h2>" + file + "</h2>");
    REQUIRE(at != std::string::npos);
    return at;
}

TEST_CASE("report: failures first, then failed parts, warnings, and the least certain", "[render][report]") {
    ReportEntry sound = entry("a"), unsure = entry("b"), warned = entry("c"), part = entry("d"),
                failed = entry("e", "timeout");
    sound.sides_confidence = 0.9;
    unsure.sides_confidence = 0.6;
    warned.sides_confidence = 1;
    warned.warnings = {"holes were closed"};
    part.messages = {"d: no rig"};
    const std::string page = report_page("set", {sound, unsure, warned, part, failed});
    const std::vector<std::string> order{"e", "d", "c", "b", "a"};
    for (std::size_t i = 1; i < order.size(); ++i) CHECK(place(page, order[i - 1]) < place(page, order[i]));
    CHECK(page.find("5 meshes, 2 failed") != std::string::npos);
    CHECK(page.find("<strong>timeout</strong>") != std::string::npos);
    CHECK(page.find("holes were closed") != std::string::npos);
}

TEST_CASE("report: numbers are shown and can be sorted by; pictures are in the page", "[render][report]") {
    ReportEntry body = entry("body.off");
    body.seconds = 1.234;
    body.faces = 13776;
    body.sides_confidence = 0.875;
    body.least_confidence = 0.5;
    body.picture = "Man";
    const std::string page = report_page("set", {body});
    CHECK(page.find("1.23 s, 13776 faces, sides 0.88, least joint 0.5") != std::string::npos);
    CHECK(page.find("data-seconds=\"1.23\" data-faces=\"13776\" data-sides=\"0.88\" data-joints=\"0.5\"") !=
          std::string::npos);
    CHECK(page.find("src=\"data:image/png;base64,TWFu\"") != std::string::npos);
    CHECK(report_page("set", {entry("x")}).find("<img") == std::string::npos);
}

TEST_CASE("report: names and reasons stay text, and nothing is loaded from anywhere", "[render][report]") {
    ReportEntry bad = entry("<img src=x>&\"", "bad_input");
    bad.messages = {"</p><script>alert(1)</script>"};
    bad.warnings = {"\x1b[31m"};
    const std::string page = report_page("<set>", {bad});
    CHECK(page.find("<img src=x>") == std::string::npos);
    CHECK(page.find("<script>alert") == std::string::npos);
    CHECK(page.find('\x1b') == std::string::npos);
    CHECK(page.find("&lt;img src=x&gt;&amp;&quot;") != std::string::npos);
    CHECK(page.find("<title>&lt;set&gt;</title>") != std::string::npos);
    CHECK(page.find("http") == std::string::npos);
    CHECK(page.find("<link") == std::string::npos);
    CHECK(report_page("nothing", {}).find("0 meshes, 0 failed") != std::string::npos);
}

} // namespace
