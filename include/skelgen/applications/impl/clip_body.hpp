#pragma once

#include <skelgen/applications/clip_body.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <skelgen/core/header_only.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {
namespace detail {

/// The joints that are known by their names.
enum class NamedPart { head, upper_spine, upper_arm, elbow, wrist, knuckles, thigh, knee, ankle, toes };

/// What a part is called, sides apart. A name that also stands for the joint before or after it counts where the
/// skeleton has no clear one: a hip may be a stub above the thigh, a shoulder the collar bone, a hand the knuckles, a
/// leg the thigh above a knee.
struct PartName {
    std::string_view name;
    NamedPart part;
    bool is_clear = true;
};

inline constexpr std::array<PartName, 56> named_parts{{
    {"head", NamedPart::head},
    {"skull", NamedPart::head},
    {"neck", NamedPart::upper_spine},
    {"spine", NamedPart::upper_spine},
    {"arm", NamedPart::upper_arm},
    {"upperarm", NamedPart::upper_arm},
    {"armupper", NamedPart::upper_arm},
    {"uparm", NamedPart::upper_arm},
    {"uarm", NamedPart::upper_arm},
    {"humerus", NamedPart::upper_arm},
    {"shldr", NamedPart::upper_arm},
    {"shoulder", NamedPart::upper_arm, false},
    {"forearm", NamedPart::elbow},
    {"lowerarm", NamedPart::elbow},
    {"armlower", NamedPart::elbow},
    {"lowarm", NamedPart::elbow},
    {"loarm", NamedPart::elbow},
    {"farm", NamedPart::elbow},
    {"elbow", NamedPart::elbow},
    {"radius", NamedPart::elbow},
    {"wrist", NamedPart::wrist},
    {"hand", NamedPart::wrist, false},
    {"palm", NamedPart::wrist, false},
    {"handmiddle", NamedPart::knuckles},
    {"middleproximal", NamedPart::knuckles},
    {"middle", NamedPart::knuckles},
    {"middlefinger", NamedPart::knuckles},
    {"fingers", NamedPart::knuckles},
    {"knuckles", NamedPart::knuckles},
    {"hand", NamedPart::knuckles, false},
    {"upleg", NamedPart::thigh},
    {"upperleg", NamedPart::thigh},
    {"legupper", NamedPart::thigh},
    {"thigh", NamedPart::thigh},
    {"femur", NamedPart::thigh},
    {"hip", NamedPart::thigh, false},
    {"leg", NamedPart::thigh, false},
    {"lowerleg", NamedPart::knee},
    {"leglower", NamedPart::knee},
    {"lowleg", NamedPart::knee},
    {"loleg", NamedPart::knee},
    {"knee", NamedPart::knee},
    {"calf", NamedPart::knee},
    {"shin", NamedPart::knee},
    {"shank", NamedPart::knee},
    {"tibia", NamedPart::knee},
    {"leg", NamedPart::knee, false},
    {"ankle", NamedPart::ankle},
    {"foot", NamedPart::ankle, false},
    {"toe", NamedPart::toes},
    {"toes", NamedPart::toes},
    {"toebase", NamedPart::toes},
    {"ball", NamedPart::toes},
    {"ballfoot", NamedPart::toes},
    {"forefoot", NamedPart::toes},
    {"foot", NamedPart::toes, false},
}};

inline bool is_part_name(std::string_view name) {
    return std::any_of(named_parts.begin(), named_parts.end(), [&](const PartName& row) { return row.name == name; });
}

/// The words of a name in lower case: "mixamorig:LeftUpLeg1" has left, up and leg, "LHip" l and hip.
inline std::vector<std::string> words_of(std::string_view name) {
    name.remove_prefix(name.find_last_of(":|") + 1); // npos + 1 is 0
    const auto is = [&](std::size_t i, int (*kind)(int)) {
        return i < name.size() && kind(static_cast<unsigned char>(name[i])) != 0;
    };
    std::vector<std::string> words;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (!is(i, std::isalpha)) continue;
        const bool begins = i == 0 || !is(i - 1, std::isalpha) ||
                            (is(i, std::isupper) && (is(i - 1, std::islower) || is(i + 1, std::islower)));
        if (begins) words.emplace_back();
        words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
    return words;
}

/// What a joint's name says: a part's name, and a side.
struct ReadName {
    std::string part;
    Side side = Side::none;
};

inline std::optional<Side> side_word(std::string_view word) {
    if (word == "left" || word == "l") return Side::left;
    if (word == "right" || word == "r") return Side::right;
    return std::nullopt;
}

/// A side written in front of a part without a gap: "lfemur", "rightarm".
inline ReadName split_prefix(const std::string& word) {
    if (!is_part_name(word))
        for (const std::string_view prefix : {"left", "right", "l", "r"})
            if (word.starts_with(prefix) && is_part_name(std::string_view(word).substr(prefix.size())))
                return {word.substr(prefix.size()), *side_word(prefix)};
    return {word, Side::none};
}

/// None for names that are no part's, as of helpers that twist with one.
inline std::optional<ReadName> read_name(const std::string& name) {
    constexpr std::array<std::string_view, 7> helpers{"ik", "pole", "target", "twist", "roll", "helper", "ctrl"};
    ReadName out;
    std::vector<std::string> words;
    for (const std::string& word : words_of(name)) {
        if (std::find(helpers.begin(), helpers.end(), word) != helpers.end()) return std::nullopt;
        if (const auto side = side_word(word))
            out.side = *side;
        else
            words.push_back(word);
    }
    // What a joint is for (the half of a limb that bends), or that it is none of a side's: m, c, x.
    constexpr std::array<std::string_view, 8> fillers{"joint", "jnt", "bone", "bend", "stretch", "m", "c", "x"};
    while (!words.empty() && std::find(fillers.begin(), fillers.end(), words.back()) != fillers.end()) words.pop_back();
    // What stands in front may be the character's name: the longest end that is a part's name.
    for (std::size_t first = 0; first < words.size(); ++first) {
        std::string joined;
        for (std::size_t i = first; i < words.size(); ++i) joined += words[i];
        const ReadName split = split_prefix(joined);
        if (!is_part_name(split.part)) continue;
        out.part = split.part;
        if (split.side != Side::none) out.side = split.side;
        return out;
    }
    return std::nullopt;
}

/// The skeleton's tree.
class ClipTree {
public:
    explicit ClipTree(const MotionClip& clip) : clip_(&clip) {}

    [[nodiscard]] int parent(int j) const { return clip_->joints[static_cast<std::size_t>(j)].parent; }

    /// From the root to the joint.
    [[nodiscard]] std::vector<int> path_to(int j) const {
        std::vector<int> path;
        for (; j >= 0; j = parent(j)) path.push_back(j);
        std::reverse(path.begin(), path.end());
        return path;
    }

    [[nodiscard]] bool is_below(int j, int above) const {
        for (j = parent(j); j >= 0; j = parent(j))
            if (j == above) return true;
        return false;
    }

    /// The last joint on both paths from the root; -1 below different roots.
    [[nodiscard]] int fork(int a, int b) const {
        const std::vector<int> to_a = path_to(a), to_b = path_to(b);
        const auto [end, unused] = std::mismatch(to_a.begin(), to_a.end(), to_b.begin(), to_b.end());
        return end == to_a.begin() ? -1 : *(end - 1);
    }

    /// The joints strictly between one and another below it.
    [[nodiscard]] std::vector<int> between(int above, int below) const {
        std::vector<int> out;
        for (int j = parent(below); j >= 0 && j != above; j = parent(j)) out.push_back(j);
        std::reverse(out.begin(), out.end());
        return out;
    }

private:
    const MotionClip* clip_;
};

/// Finds the parts of one skeleton.
class PartFinder {
public:
    explicit PartFinder(const MotionClip& clip) {
        for (const ClipJoint& joint : clip.joints) names_.push_back(read_name(joint.name));
    }

    /// The first joint that is clearly called so, or else that may be; -1 where there is none.
    [[nodiscard]] int find(NamedPart part, Side side) const {
        for (const bool is_clear : {true, false})
            for (std::size_t j = 0; j < names_.size(); ++j)
                if (names_[j] && names_[j]->side == side && is_called(names_[j]->part, part, is_clear))
                    return static_cast<int>(j);
        return -1;
    }

    /// The last joint below another that may be called so; -1 where there is none.
    [[nodiscard]] int find_last(NamedPart part, const ClipTree& tree, int above) const {
        for (auto j = static_cast<int>(names_.size()) - 1; j >= 0; --j) {
            const auto& name = names_[static_cast<std::size_t>(j)];
            if (name && name->side == Side::none && is_called(name->part, part, true) && tree.is_below(j, above))
                return j;
        }
        return -1;
    }

    /// Whether two joints are called the same, sides apart.
    [[nodiscard]] bool are_alike(int a, int b) const {
        return names_[static_cast<std::size_t>(a)]->part == names_[static_cast<std::size_t>(b)]->part;
    }

private:
    static bool is_called(std::string_view name, NamedPart part, bool is_clear) {
        return std::any_of(named_parts.begin(), named_parts.end(), [&](const PartName& row) {
            return row.name == name && row.part == part && row.is_clear == is_clear;
        });
    }

    std::vector<std::optional<ReadName>> names_;
};

/// What a limb's joints are called, from the trunk on: as parts, and all but the tip in messages.
struct LimbNames {
    std::array<NamedPart, 4> parts;
    std::array<const char*, 3> words;
};
inline constexpr LimbNames arm_names{{NamedPart::upper_arm, NamedPart::elbow, NamedPart::wrist, NamedPart::knuckles},
                                     {"upper arm", "forearm", "hand"}};
inline constexpr LimbNames leg_names{{NamedPart::thigh, NamedPart::knee, NamedPart::ankle, NamedPart::toes},
                                     {"thigh", "shin", "foot"}};

/// A limb, whose tip must lie beyond its end: a hand is the wrist where there is no wrist.
inline ClipLimb find_limb(const PartFinder& parts, const ClipTree& tree, Side side, const LimbNames& names) {
    ClipLimb limb{parts.find(names.parts[0], side), parts.find(names.parts[1], side), parts.find(names.parts[2], side),
                  parts.find(names.parts[3], side)};
    if (limb.tip >= 0 && (limb.end < 0 || !tree.is_below(limb.tip, limb.end))) limb.tip = -1;
    return limb;
}

/// What a limb lacks; empty where nothing does.
inline std::string fault_of(const ClipLimb& limb, const ClipTree& tree, const std::string& side,
                            const LimbNames& names) {
    const std::array<int, 3> joints{limb.upper, limb.lower, limb.end};
    for (std::size_t i = 0; i < joints.size(); ++i)
        if (joints[i] < 0) return "no joint is named as a " + side + " " + names.words[i];
    for (std::size_t i = 1; i < joints.size(); ++i)
        if (!tree.is_below(joints[i], joints[i - 1]))
            return "its " + side + " " + names.words[i] + " does not hang on the " + names.words[i - 1];
    return "";
}

/// What the limbs of a left and a right side lack; empty where nothing does.
inline std::string fault_of(const std::array<ClipLimb, 2>& limbs, const PartFinder& parts, const ClipTree& tree,
                            const LimbNames& names) {
    for (const std::size_t i : {0U, 1U})
        if (std::string fault = fault_of(limbs[i], tree, i == 0 ? "left" : "right", names); !fault.empty())
            return fault;
    // A side without upper arm must not have its collar bone taken for one.
    constexpr std::array<int ClipLimb::*, 3> joints{&ClipLimb::upper, &ClipLimb::lower, &ClipLimb::end};
    for (std::size_t i = 0; i < joints.size(); ++i)
        if (!parts.are_alike(limbs[0].*joints[i], limbs[1].*joints[i]))
            return std::string("left and right ") + names.words[i] + " are named differently";
    return "";
}

/// Whether legs hang on the pelvis, arms on the chest, and pelvis, chest and head on each other or on a joint below
/// all.
inline bool hangs_together(const ClipBody& body, const ClipTree& tree) {
    bool limbs_hang = true;
    for (const ClipLimb& leg : body.legs) limbs_hang = limbs_hang && tree.is_below(leg.upper, body.pelvis);
    for (const ClipLimb& arm : body.arms) limbs_hang = limbs_hang && tree.is_below(arm.upper, body.chest);
    const int trunk = tree.fork(body.pelvis, body.chest);
    return limbs_hang && trunk >= 0 && !tree.is_below(body.pelvis, body.chest) && tree.is_below(body.head, trunk) &&
           body.head != body.chest && !tree.is_below(body.chest, body.head);
}

} // namespace detail

SKELGEN_INLINE Outcome<ClipBody> find_body(const MotionClip& clip) {
    validate(clip);
    const auto failed = [](const std::string& fault) {
        return Failure{Refusal::none,
                       "the clip's skeleton is not known as a body: " + fault +
                           "; name its joints as Mixamo, VRM, SMPL or skelgen does, as Hips, LeftUpLeg, LeftLeg"};
    };
    const detail::PartFinder parts(clip);
    const detail::ClipTree tree(clip);
    ClipBody body;
    for (const std::size_t i : {0U, 1U}) {
        const Side side = i == 0 ? Side::left : Side::right;
        body.legs[i] = detail::find_limb(parts, tree, side, detail::leg_names);
        body.arms[i] = detail::find_limb(parts, tree, side, detail::arm_names);
    }
    for (const std::string& fault : {detail::fault_of(body.legs, parts, tree, detail::leg_names),
                                     detail::fault_of(body.arms, parts, tree, detail::arm_names)})
        if (!fault.empty()) return failed(fault);
    body.pelvis = tree.fork(body.legs[0].upper, body.legs[1].upper);
    body.chest = tree.fork(body.arms[0].upper, body.arms[1].upper);
    body.head = parts.find(detail::NamedPart::head, Side::none);
    if (body.head < 0) // Rigify counts the spine through to the head
        body.head = parts.find_last(detail::NamedPart::upper_spine, tree, body.chest);
    if (body.head < 0) return failed("no joint is named as a head");
    if (!detail::hangs_together(body, tree)) return failed("trunk, head and limbs do not hang together as a body's do");
    // The chest may hang beside the pelvis, both on the hip, as Daz has it.
    body.spine = tree.between(tree.fork(body.pelvis, body.chest), body.chest);
    // A head may hang below the chest, on the pelvis' side of it: its neck begins where the two part.
    body.neck = tree.between(tree.fork(body.head, body.chest), body.head);
    return body;
}

} // namespace skelgen::applications
