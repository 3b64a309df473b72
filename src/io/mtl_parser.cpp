#include "mtl_parser.hpp"

#include <algorithm>
#include <cmath>

#include "plain_content.hpp"
#include "text_scanner.hpp"

namespace skelgen::io::detail {
namespace {

/// Options of a map and how many words follow each; of three the last ones may be missing.
struct MapOption {
    std::string_view name;
    int words;
};

constexpr std::array<MapOption, 14> map_options{{{"-blendu", 1},
                                                 {"-blendv", 1},
                                                 {"-boost", 1},
                                                 {"-bm", 1},
                                                 {"-cc", 1},
                                                 {"-clamp", 1},
                                                 {"-colorspace", 1},
                                                 {"-imfchan", 1},
                                                 {"-mm", 2},
                                                 {"-o", 3},
                                                 {"-s", 3},
                                                 {"-t", 3},
                                                 {"-texres", 1},
                                                 {"-type", 1}}};

/// The name behind a map's options, in the spelling of paths that all systems know.
std::string map_file(TextScanner& scanner) {
    for (;;) {
        const std::string_view word = scanner.peek_word();
        const auto* const option = std::find_if(map_options.begin(), map_options.end(),
                                                [&](const MapOption& known) { return known.name == word; });
        if (option == map_options.end()) break;
        static_cast<void>(scanner.word());
        for (int i = 0; i < option->words; ++i) {
            TextScanner ahead = scanner;
            if (option->words == 3 && (ahead.at_line_end() || !ahead.try_number())) break;
            static_cast<void>(scanner.word());
        }
    }
    std::string file(scanner.rest_of_line());
    if (file.size() > 1 && file.front() == '"' && file.back() == '"') file = file.substr(1, file.size() - 2);
    std::replace(file.begin(), file.end(), '\\', '/');
    return file;
}

double part_of_one(TextScanner& scanner, double otherwise) {
    return scanner.at_line_end() ? otherwise : std::clamp(scanner.try_number().value_or(otherwise), 0.0, 1.0);
}

class MtlParser {
public:
    explicit MtlParser(std::string_view text) : scanner_(text, "material") {}

    std::vector<MtlMaterial> parse() {
        while (scanner_.seek_word()) {
            const std::string_view keyword = scanner_.word();
            if (keyword == "newmtl") {
                materials_.push_back({std::string(scanner_.rest_of_line())});
                says_opacity_ = says_roughness_ = false;
            } else if (materials_.empty() || !read_whole_line(keyword)) {
                if (!materials_.empty()) read_numbers(keyword);
                scanner_.skip_line();
            }
        }
        return std::move(materials_);
    }

private:
    /// What ends with its line. Whether the keyword was one of that.
    bool read_whole_line(std::string_view keyword) {
        if (keyword == "map_Kd")
            materials_.back().colour_map = map_file(scanner_);
        else if (keyword == "map_d")
            materials_.back().opacity_map = map_file(scanner_);
        else
            return false;
        return true;
    }

    void read_numbers(std::string_view keyword) {
        MtlMaterial& material = materials_.back();
        if (keyword == "Kd") {
            read_colour(material);
        } else if (keyword == "d") {
            if (scanner_.peek_word() == "-halo") static_cast<void>(scanner_.word());
            material.opacity = part_of_one(scanner_, 1);
            says_opacity_ = true;
        } else if (keyword == "Tr" && !says_opacity_) {
            material.opacity = 1 - part_of_one(scanner_, 0);
        } else if (keyword == "Pr") {
            material.roughness = part_of_one(scanner_, 1);
            says_roughness_ = true;
        } else if (keyword == "Ns" && !says_roughness_) {
            constexpr double shiniest = 1000; // of Blender's exporter: (1 - roughness)^2 of it
            material.roughness = 1 - std::sqrt(std::clamp(scanner_.try_number().value_or(0) / shiniest, 0.0, 1.0));
        } else if (keyword == "Pm") {
            material.metalness = part_of_one(scanner_, 0);
        }
    }

    /// One number alone is a grey; spectra and CIE's colours are no numbers, and skipped.
    void read_colour(MtlMaterial& material) {
        std::array<double, 3> colour{};
        std::size_t channels = 0;
        for (; channels < colour.size() && !scanner_.at_line_end(); ++channels) {
            const auto value = scanner_.try_number();
            if (!value) return;
            colour[channels] = std::clamp(*value, 0.0, 1.0);
        }
        if (channels == 1) colour.fill(colour.front());
        if (channels != 0) material.colour = colour;
    }

    TextScanner scanner_;
    std::vector<MtlMaterial> materials_;
    bool says_opacity_ = false, says_roughness_ = false; ///< of the last material, by the word that counts more
};

} // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text) {
    std::string converted;
    return MtlParser(with_line_feeds(text, converted)).parse();
}

} // namespace skelgen::io::detail
