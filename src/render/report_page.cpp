#include <skelgen/render/report_page.hpp>

#include <algorithm>
#include <tuple>

#include "io/base64.hpp"
#include "xml_text.hpp"

namespace skelgen::render {
namespace {

constexpr const char* style = R"(
body { font: 14px/1.4 system-ui, sans-serif; margin: 1.5em; color: #222; background: #f6f6f4 }
h1 { font-size: 1.3em; margin: 0 0 .3em }
#tools { position: sticky; top: 0; padding: .6em 0; background: #f6f6f4; display: flex; gap: 1em; flex-wrap: wrap }
#meshes { display: grid; grid-template-columns: repeat(auto-fill, minmax(17em, 1fr)); gap: 1em; padding: 0 }
#meshes li { list-style: none; background: #fff; border: 1px solid #ddd; border-radius: 6px; padding: .7em }
#meshes li.failed { border-color: #c0392b }
#meshes li.warned { border-color: #c98a00 }
#meshes li[hidden] { display: none }
img { display: block; width: 100%; height: 16em; object-fit: contain }
h2 { font-size: 1em; margin: .3em 0; overflow-wrap: anywhere }
p { margin: .2em 0; overflow-wrap: anywhere }
.error { color: #c0392b } .warning { color: #8a6100 } .numbers { color: #666 }
)";

/// Sorts and filters what the page holds already.
constexpr const char* script = R"(
const list = document.getElementById("meshes"), items = [...list.children];
const find = document.getElementById("find"), show = document.getElementById("show");
const order = document.getElementById("order"), count = document.getElementById("count");
const number = (item, key) => item.dataset[key] === "" ? -1 : Number(item.dataset[key]);
const orders = {
  rank: (a, b) => a.dataset.rank - b.dataset.rank,
  name: (a, b) => a.dataset.file < b.dataset.file ? -1 : 1,
  slow: (a, b) => number(b, "seconds") - number(a, "seconds"),
  large: (a, b) => number(b, "faces") - number(a, "faces"),
  sides: (a, b) => number(a, "sides") - number(b, "sides"),
  joints: (a, b) => number(a, "joints") - number(b, "joints"),
};
const kinds = {
  all: () => true,
  failed: (item) => item.classList.contains("failed"),
  warned: (item) => item.classList.contains("warned"),
  sound: (item) => item.classList.contains("sound"),
};
function update() {
  const words = find.value.toLowerCase().split(" ").filter(Boolean);
  let shown = 0;
  for (const item of items) {
    const text = item.textContent.toLowerCase();
    item.hidden = !kinds[show.value](item) || !words.every((word) => text.includes(word));
    shown += item.hidden ? 0 : 1;
  }
  list.append(...items.sort(orders[order.value]));
  count.textContent = shown + " of " + items.length;
}
for (const field of [find, show, order]) field.addEventListener("input", update);
update();
)";

constexpr const char* tools = R"(<form id="tools" onsubmit="return false">
<label>Find <input id="find" type="search"></label>
<label>Show <select id="show"><option value="all">all</option><option value="failed">failed</option>
<option value="warned">with warnings</option><option value="sound">without</option></select></label>
<label>Order <select id="order"><option value="rank">failures first</option><option value="name">name</option>
<option value="slow">slowest first</option><option value="large">largest first</option>
<option value="sides">least certain sides first</option><option value="joints">least certain joint first</option>
</select></label>
<output id="count"></output>
</form>
)";

const char* kind_of(const ReportEntry& entry) {
    if (entry.status != "ok" || !entry.messages.empty()) return "failed";
    return entry.warnings.empty() ? "sound" : "warned";
}

/// Smaller for what is to be looked at first.
auto rank_of(const ReportEntry& entry) {
    const int kind = entry.status != "ok" ? 0 : !entry.messages.empty() ? 1 : !entry.warnings.empty() ? 2 : 3;
    return std::tuple(kind, entry.sides_confidence.value_or(0), entry.file);
}

std::string text_of(const std::optional<double>& number) { return number ? decimal(*number) : std::string(); }

std::string data_attribute(const char* name, const std::string& value) {
    return std::string(" data-") + name + "=\"" + xml_text(value) + "\"";
}

std::string paragraphs(const std::vector<std::string>& texts, const char* kind) {
    std::string out;
    for (const std::string& text : texts) out += std::string("<p class=\"") + kind + "\">" + xml_text(text) + "</p>\n";
    return out;
}

std::string numbers_of(const ReportEntry& entry) {
    std::string out = decimal(entry.seconds) + " s";
    if (entry.faces > 0) out += ", " + std::to_string(entry.faces) + " faces";
    if (entry.sides_confidence) out += ", sides " + decimal(*entry.sides_confidence);
    if (entry.least_confidence) out += ", least joint " + decimal(*entry.least_confidence);
    return "<p class=\"numbers\">" + out + "</p>\n";
}

std::string item_of(const ReportEntry& entry, std::size_t rank) {
    std::string out = std::string("<li class=\"") + kind_of(entry) + "\"" +
                      data_attribute("rank", std::to_string(rank)) + data_attribute("file", entry.file) +
                      data_attribute("seconds", decimal(entry.seconds)) +
                      data_attribute("faces", std::to_string(entry.faces)) +
                      data_attribute("sides", text_of(entry.sides_confidence)) +
                      data_attribute("joints", text_of(entry.least_confidence)) + ">\n";
    if (!entry.picture.empty())
        out += "<img alt=\"" + xml_text(entry.file) + "\" loading=\"lazy\" src=\"data:image/png;base64," +
               io::detail::encode_base64(entry.picture) + "\">\n";
    out += "<h2>" + xml_text(entry.file) + "</h2>\n";
    if (entry.status != "ok") out += "<p class=\"error\"><strong>" + xml_text(entry.status) + "</strong></p>\n";
    return out + paragraphs(entry.messages, "error") + paragraphs(entry.warnings, "warning") + numbers_of(entry) +
           "</li>\n";
}

std::string count_of(const std::vector<ReportEntry>& entries) {
    const auto failed = std::count_if(entries.begin(), entries.end(),
                                      [](const ReportEntry& entry) { return std::string(kind_of(entry)) == "failed"; });
    double seconds = 0;
    for (const ReportEntry& entry : entries) seconds += entry.seconds;
    return std::to_string(entries.size()) + " meshes, " + std::to_string(failed) + " failed, " + decimal(seconds) +
           " s of work";
}

} // namespace

std::string report_page(const std::string& title, std::vector<ReportEntry> entries) {
    std::sort(entries.begin(), entries.end(),
              [](const ReportEntry& a, const ReportEntry& b) { return rank_of(a) < rank_of(b); });
    std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
                       xml_text(title) + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n<h1>" +
                       xml_text(title) + "</h1>\n<p>" + count_of(entries) + "</p>\n" + tools + "<ul id=\"meshes\">\n";
    for (std::size_t i = 0; i < entries.size(); ++i) page += item_of(entries[i], i);
    return page + "</ul>\n<script>" + script + "</script>\n</body>\n</html>\n";
}

} // namespace skelgen::render
