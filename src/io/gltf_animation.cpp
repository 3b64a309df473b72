#include "gltf_animation.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "animation_choice.hpp"

namespace skelgen::io::detail {
namespace {

template <typename Enum, std::size_t Count>
std::optional<Enum> find_name(const std::array<std::pair<std::string_view, Enum>, Count>& names,
                              std::string_view wanted) {
    for (const auto& [name, value] : names)
        if (name == wanted) return value;
    return std::nullopt;
}

constexpr std::array<std::pair<std::string_view, AnimatedProperty>, 4> properties{
    {{"translation", AnimatedProperty::translation},
     {"rotation", AnimatedProperty::rotation},
     {"scale", AnimatedProperty::scale},
     {"weights", AnimatedProperty::weights}}};
constexpr std::array<std::pair<std::string_view, Interpolation>, 3> interpolations{
    {{"STEP", Interpolation::step}, {"LINEAR", Interpolation::linear}, {"CUBICSPLINE", Interpolation::cubic}}};

std::size_t property_columns(AnimatedProperty property) {
    switch (property) {
    case AnimatedProperty::weights:
        return 1;
    case AnimatedProperty::rotation:
        return 4;
    case AnimatedProperty::translation:
    case AnimatedProperty::scale:
        break;
    }
    return 3;
}

/// None for a channel of something that is no node, or of no shape: a colour, say.
std::optional<AnimationChannel> read_channel(GltfData& data, const GltfValue& animation, const GltfValue& value) {
    const GltfValue target = value.at("target");
    const auto node = target.find("node");
    const auto property = find_name(properties, target.at("path").text());
    if (!node || !property) return std::nullopt;

    AnimationChannel channel;
    channel.node = node->whole_number();
    static_cast<void>(data.file().referred("nodes", *node)); // there it is
    channel.property = *property;
    const GltfValue sampler = animation.at("samplers")[value.at("sampler").whole_number()];
    if (const auto named = sampler.find("interpolation")) {
        const auto interpolation = find_name(interpolations, named->text());
        if (!interpolation) named->fail("is none of LINEAR, STEP and CUBICSPLINE");
        channel.interpolation = *interpolation;
    }
    channel.times = data.accessor(sampler.at("input"), 1).values;
    channel.values = data.accessor(sampler.at("output"), property_columns(*property)).values;
    return channel;
}

} // namespace

std::vector<AnimationChannel> read_animation(GltfData& data, const std::string& name) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < data.file().count("animations"); ++i) {
        const auto named = data.file().root().at("animations")[i].find("name");
        names.push_back(named ? named->text() : "");
    }
    const GltfValue animation = data.file().root().at("animations")[choose_animation(names, name)];
    const GltfValue values = animation.at("channels");
    std::vector<AnimationChannel> channels;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (auto channel = read_channel(data, animation, values[i])) channels.push_back(*std::move(channel));
    return channels;
}

} // namespace skelgen::io::detail
