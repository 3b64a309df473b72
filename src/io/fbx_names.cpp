#include "fbx_names.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "little_endian.hpp"

namespace skelgen::io::detail {
namespace {

constexpr std::size_t version_place = 23;    // in a binary file
constexpr int first_with_numbers = 7000;     // whose nodes have numbers beside their names
constexpr int first_with_long_places = 7500; // 64 bits in place of 32

/// A part of the file.
struct Span {
    std::size_t from = 0, size = 0;
};

/// A node of a binary file: its name, where its properties are, where the nodes in it and where it ends.
struct BinaryNode {
    std::string_view name;
    std::size_t properties = 0, children = 0, end = 0;
};

class BinaryFile {
public:
    explicit BinaryFile(std::string_view bytes)
        : bytes_(bytes), is_long_(version_of_fbx(bytes) >= first_with_long_places) {}

    /// The names of all nodes of the scene ("Model"), without their class.
    [[nodiscard]] std::vector<Span> names() const {
        std::vector<Span> out;
        const std::size_t first = version_place + 4;
        each(first, bytes_.size(), [&](const BinaryNode& node) {
            if (node.name != "Objects") return;
            each(node.children, node.end, [&](const BinaryNode& object) {
                if (object.name != "Model") return;
                // A number of 64 bits, and the name.
                const std::size_t length = object.properties + 10;
                if (length + 4 > object.children || bytes_[object.properties] != 'L' || bytes_[length - 1] != 'S')
                    return;
                const auto size = read_little_endian<std::uint32_t>(bytes_.substr(length, 4));
                if (size > object.children - length - 4) return;
                const std::string_view name = bytes_.substr(length + 4, size);
                out.push_back({length + 4, std::min(name.find('\0'), name.size())});
            });
        });
        return out;
    }

private:
    template <typename Visit>
    void each(std::size_t from, std::size_t to, const Visit& visit) const {
        while (const auto node = node_at(from, to)) {
            visit(*node);
            from = node->end;
        }
    }

    /// None behind the last one.
    [[nodiscard]] std::optional<BinaryNode> node_at(std::size_t from, std::size_t to) const {
        const std::size_t width = is_long_ ? 8 : 4, head = 3 * width + 1;
        if (from > to || to - from < head) return std::nullopt;
        const auto number = [&](std::size_t i) -> std::size_t {
            const std::string_view bytes = bytes_.substr(from + i * width, width);
            return is_long_ ? read_little_endian<std::uint64_t>(bytes) : read_little_endian<std::uint32_t>(bytes);
        };
        const std::size_t end = number(0), size = number(2);
        const std::size_t properties = from + head + static_cast<unsigned char>(bytes_[from + head - 1]);
        if (end <= from || end > to || properties > end || size > end - properties) return std::nullopt;
        return BinaryNode{bytes_.substr(from + head, properties - from - head), properties, properties + size, end};
    }

    std::string_view bytes_;
    bool is_long_;
};

/// The names in a text: `Model: 123, "Model::NAME", "LimbNode"`.
std::vector<Span> names_in_text(std::string_view text) {
    constexpr std::string_view object = "Model: ", name_class = "\"Model::";
    std::vector<Span> out;
    for (std::size_t at = text.find(object); at != std::string_view::npos; at = text.find(object, at + 1)) {
        const std::size_t line = std::min(text.find('\n', at), text.size());
        const std::size_t name = text.substr(0, line).find(name_class, at);
        if (name == std::string_view::npos) continue;
        const std::size_t from = name + name_class.size(), end = text.substr(0, line).find('"', from);
        if (end != std::string_view::npos) out.push_back({from, end - from});
    }
    return out;
}

/// A name as long as another that is not taken: with other characters at its end. Empty where there is none.
std::string free_name(const std::string& name, const std::set<std::string>& taken) {
    constexpr std::string_view digits = "0123456789abcdefghijklmnopqrstuvwxyz";
    const std::size_t changed = std::min<std::size_t>(name.size(), 4);
    std::size_t most = 1;
    for (std::size_t i = 0; i < changed; ++i) most *= digits.size();
    for (std::size_t number = 1; number < most; ++number) {
        std::string out = name;
        std::size_t rest = number;
        for (std::size_t i = 1; rest > 0; ++i, rest /= digits.size())
            out[out.size() - i] = digits[rest % digits.size()];
        if (!taken.contains(out)) return out;
    }
    return "";
}

} // namespace

int version_of_fbx(std::string_view fbx) {
    if (fbx.starts_with("Kaydara FBX Binary"))
        return fbx.size() < version_place + 4
                   ? 0
                   : static_cast<int>(read_little_endian<std::uint32_t>(fbx.substr(version_place, 4)));
    constexpr std::string_view key = "FBXVersion:";
    const std::size_t found = fbx.find(key);
    if (found == std::string_view::npos) return 0;
    const std::size_t number = std::min(fbx.find_first_not_of(' ', found + key.size()), fbx.size());
    int version = 0;
    std::from_chars(fbx.data() + number, fbx.data() + fbx.size(), version);
    return version;
}

std::string with_names_apart(std::string_view fbx) {
    std::string out(fbx);
    if (version_of_fbx(fbx) < first_with_numbers) return out;
    const std::vector<Span> spans =
        fbx.starts_with("Kaydara FBX Binary") ? BinaryFile(fbx).names() : names_in_text(fbx);
    std::set<std::string> all, seen;
    for (const Span& span : spans) all.emplace(fbx.substr(span.from, span.size));
    for (const Span& span : spans) {
        const std::string name(fbx.substr(span.from, span.size));
        if (seen.insert(name).second) continue;
        const std::string free = free_name(name, all);
        out.replace(span.from, free.size(), free);
        all.insert(free);
    }
    return out;
}

} // namespace skelgen::io::detail
