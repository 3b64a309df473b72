#include "lost_pictures.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skelgen::io::detail {
namespace {

using LooksJson = GltfValue::Json;

/// Per element of a list the number that it has without the lost ones; none for these.
using NewNumbers = std::vector<std::optional<std::size_t>>;

NewNumbers numbers_without(std::size_t count, const std::set<std::size_t>& lost) {
    NewNumbers numbers(count);
    std::size_t next = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (!lost.contains(i)) numbers[i] = next++;
    return numbers;
}

/// Gives the reference its new number, or takes it away. Whether there is none now.
bool renumber(LooksJson& holder, const char* key, const NewNumbers& numbers, const std::string& place) {
    const auto found = holder.find(key);
    if (found == holder.end()) return true;
    const GltfValue reference(*found, place + "." + key);
    const std::size_t number = reference.whole_number();
    if (number >= numbers.size()) reference.fail("refers to an entry that does not exist");
    if (!numbers[number]) {
        holder.erase(found);
        return true;
    }
    *found = *numbers[number];
    return false;
}

/// Whether a texture is without any picture, its own or one of an extension's kind (KHR_texture_basisu,
/// EXT_texture_webp, ...), once the lost ones are taken away.
bool loses_all(LooksJson& texture, const NewNumbers& images, const std::string& place) {
    bool without = renumber(texture, "source", images, place);
    if (const auto extensions = texture.find("extensions"); extensions != texture.end() && extensions->is_object())
        for (auto extension = extensions->begin(); extension != extensions->end();) {
            const bool shows = extension->is_object() && extension->contains("source");
            const bool lost = shows && renumber(*extension, "source", images, place + "." + extension.key());
            without = without && (!shows || lost);
            extension = lost ? extensions->erase(extension) : std::next(extension);
        }
    return without;
}

/// Of anything in a material, the references to textures: members whose names end so ("normalTexture"), with an index.
void renumber_textures(LooksJson& value, const NewNumbers& textures, const std::string& place) {
    if (value.is_array())
        for (LooksJson& element : value) renumber_textures(element, textures, place);
    if (!value.is_object()) return;
    for (auto member = value.begin(); member != value.end();) {
        const std::string& key = member.key();
        const bool names_texture =
            std::string_view(key).ends_with("Texture") && member->is_object() && member->contains("index");
        if (names_texture && renumber(*member, "index", textures, place + "." + key)) {
            member = value.erase(member);
            continue;
        }
        renumber_textures(*member, textures, place);
        ++member;
    }
}

std::size_t count(const LooksJson& looks, const char* list) { return looks.contains(list) ? looks.at(list).size() : 0; }

void take_out(LooksJson& looks, const char* list, const std::set<std::size_t>& lost) {
    if (lost.empty()) return;
    LooksJson kept = LooksJson::array();
    for (std::size_t i = 0; i < looks[list].size(); ++i)
        if (!lost.contains(i)) kept.push_back(std::move(looks[list][i]));
    looks[list] = std::move(kept);
    if (looks[list].empty()) looks.erase(list);
}

} // namespace

LooksJson without_pictures(LooksJson looks, const std::set<std::size_t>& lost) {
    const NewNumbers images = numbers_without(count(looks, "images"), lost);
    take_out(looks, "images", lost);
    std::set<std::size_t> bare;
    for (std::size_t i = 0; i < count(looks, "textures"); ++i)
        if (loses_all(looks["textures"][i], images, "textures[" + std::to_string(i) + "]")) bare.insert(i);
    const NewNumbers textures = numbers_without(count(looks, "textures"), bare);
    take_out(looks, "textures", bare);
    for (std::size_t i = 0; i < count(looks, "materials"); ++i)
        renumber_textures(looks["materials"][i], textures, "materials[" + std::to_string(i) + "]");
    return looks;
}

} // namespace skelgen::io::detail
