#include <skelgen/io/scene_looks.hpp>

#include <utility>

#include "json_values.hpp"

namespace skelgen::io {

SceneLooks with_credits(SceneLooks looks, const Credits& credits) {
    detail::Json about = detail::parse_json(looks.about);
    const std::string title = detail::valid_utf8(credits.title), author = detail::valid_utf8(credits.author),
                      license = detail::valid_utf8(credits.license);
    const auto say = [&](const char* key, const std::string& text) {
        if (text.empty()) return;
        if (!about.contains("extras") || !about["extras"].is_object()) about["extras"] = detail::Json::object();
        about["extras"][key] = text;
    };
    say("title", title);
    say("author", author);
    say("license", license);
    if (!author.empty()) about["copyright"] = author;
    looks.about = about.dump();
    if (looks.vrm.empty()) return looks;
    detail::Json vrm = detail::parse_json(looks.vrm);
    if (!title.empty()) vrm["meta"]["name"] = title;
    if (!author.empty()) vrm["meta"]["authors"] = detail::Json::array({author});
    if (!license.empty()) {
        const bool is_address = license.starts_with("http");
        vrm["meta"].erase(is_address ? "thirdPartyLicenses" : "otherLicenseUrl");
        vrm["meta"][is_address ? "otherLicenseUrl" : "thirdPartyLicenses"] = license;
    }
    looks.vrm = vrm.dump();
    return looks;
}

} // namespace skelgen::io
