#include <skelgen/io/bvh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "plain_content.hpp"
#include "text_scanner.hpp"

namespace skelgen::io {
namespace {

using applications::ClipChannel;
using applications::ClipJoint;
using applications::MotionClip;

/// Programs write keywords in any case.
bool is_same_word(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

// What a clip may be at most, so that one made to fill a machine's memory, or its day, does not: each frame is kept as
// a pose of the whole rig, and takes a look at each joint.
constexpr std::size_t deepest = 500;          ///< joints below each other; what shows them may be recursive
constexpr std::size_t most_joints = 5000;     ///< several times those of a character whose face moves, too
constexpr std::int64_t most_frames = 1000000; ///< more than two hours at 120 frames a second

class BvhParser {
public:
    explicit BvhParser(std::string_view text) : scanner_(text, "clip") {}

    MotionClip parse() {
        expect("HIERARCHY");
        expect("ROOT");
        open_joint(-1);
        while (!open_.empty()) read_entry();
        if (next_word() != "MOTION") {
            scanner_.fail_at(word_start_, is_same_word(word_, "ROOT")
                                              ? "a second ROOT begins, but only clips of one skeleton are read"
                                              : "MOTION is missing after the hierarchy");
        }
        read_motion();
        return std::move(clip_);
    }

private:
    /// The next word, over ends of lines; an upper-case keyword's spelling where it is one in another case.
    std::string_view next_word() {
        if (!scanner_.seek_word()) scanner_.fail("the file ends too early");
        word_start_ = scanner_.position();
        word_ = scanner_.word();
        constexpr std::array<std::string_view, 7> keywords{"HIERARCHY", "ROOT", "JOINT", "OFFSET",
                                                           "CHANNELS",  "END",  "MOTION"};
        for (const std::string_view keyword : keywords)
            if (is_same_word(word_, keyword)) return keyword;
        return word_;
    }

    void expect(const char* wanted) {
        if (next_word() != wanted) scanner_.fail_at(word_start_, std::string(wanted) + " is missing");
    }

    /// The rest of the line: names may have blanks; the brace may stand right behind them.
    std::string read_name() {
        std::string name;
        while (!scanner_.at_line_end()) {
            const char* const start = scanner_.position();
            std::string_view word = scanner_.word();
            const std::size_t brace = word.find('{');
            if (brace != std::string_view::npos) {
                scanner_.move_to(start + brace);
                word = word.substr(0, brace);
            }
            if (!name.empty() && !word.empty()) name += ' ';
            name += word;
            if (brace != std::string_view::npos) break;
        }
        return name;
    }

    void open_joint(int parent) {
        if (open_.size() >= deepest) scanner_.fail("joints are nested more than " + std::to_string(deepest) + " deep");
        ClipJoint joint;
        joint.parent = parent;
        if (clip_.joints.size() >= most_joints)
            scanner_.fail("there are more than " + std::to_string(most_joints) + " joints");
        joint.name = read_name();
        if (joint.name.empty()) scanner_.fail("a joint's name is missing");
        expect("{");
        open_.push_back({static_cast<int>(clip_.joints.size())});
        clip_.joints.push_back(std::move(joint));
    }

    void read_entry() {
        const std::string_view keyword = next_word();
        OpenJoint& open = open_.back();
        ClipJoint& joint = clip_.joints[static_cast<std::size_t>(open.index)];
        if (keyword == "OFFSET") {
            if (std::exchange(open.has_offset, true)) scanner_.fail_at(word_start_, "a joint has two offsets");
            joint.offset = read_offset();
        } else if (keyword == "CHANNELS") {
            if (std::exchange(open.has_channels, true)) scanner_.fail_at(word_start_, "a joint has channels twice");
            joint.channels = read_channels();
        } else if (keyword == "JOINT") {
            open_joint(open.index);
        } else if (keyword == "END") {
            joint.end = read_end();
        } else if (keyword == "}") {
            if (!open.has_offset) scanner_.fail_at(word_start_, "the joint that ends here has no OFFSET");
            open_.pop_back();
        } else {
            scanner_.fail_at(word_start_, "OFFSET, CHANNELS, JOINT, End Site or } is missing");
        }
    }

    /// Numbers in which lengths and angles can be reckoned with: what a float holds.
    double read_number(const char* what) {
        if (scanner_.at_line_end() && !scanner_.seek_word()) scanner_.fail("the file ends too early");
        const char* const start = scanner_.position();
        const auto value = scanner_.number<double>(what);
        if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max()))
            scanner_.fail_at(start, std::string("the ") + what + " is too large");
        return value;
    }

    Vector3<double> read_offset() {
        const double x = read_number("offset's x"), y = read_number("offset's y"), z = read_number("offset's z");
        return {x, y, z};
    }

    Vector3<double> read_end() {
        scanner_.skip_line(); // "Site"
        expect("{");
        expect("OFFSET");
        Vector3<double> end = read_offset();
        expect("}");
        return end;
    }

    std::vector<ClipChannel> read_channels() {
        constexpr std::array<std::string_view, 6> names{"Xposition", "Yposition", "Zposition",
                                                        "Xrotation", "Yrotation", "Zrotation"};
        const std::int64_t count = scanner_.whole_integer("number of channels");
        if (count < 0 || count > static_cast<std::int64_t>(names.size()))
            scanner_.fail("a joint has up to 6 channels, not " + std::to_string(count));
        std::vector<ClipChannel> channels;
        for (std::int64_t i = 0; i < count; ++i) {
            const std::string_view word = next_word();
            const auto* const name = std::find_if(names.begin(), names.end(),
                                                  [&](std::string_view known) { return is_same_word(known, word); });
            if (name == names.end())
                scanner_.fail_at(word_start_, "a channel is none of Xposition, Yposition, Zposition, Xrotation, "
                                              "Yrotation and Zrotation");
            const auto channel = static_cast<ClipChannel>(name - names.begin());
            if (std::find(channels.begin(), channels.end(), channel) != channels.end())
                scanner_.fail_at(word_start_, "a joint has the channel " + std::string(*name) + " twice");
            channels.push_back(channel);
        }
        channels_ += channels.size();
        return channels;
    }

    /// A title as "Frames:", with or without blanks around the colon, the number behind it not yet read.
    void expect_title(std::initializer_list<std::string_view> words) {
        const auto fail = [&] {
            std::string title;
            for (const std::string_view word : words) title += (title.empty() ? "" : " ") + std::string(word);
            scanner_.fail("\"" + title + ":\" is missing");
        };
        for (const std::string_view word : words) {
            if (!scanner_.seek_word()) fail();
            const char* const start = scanner_.position();
            if (!is_same_word(scanner_.word().substr(0, word.size()), word)) fail();
            scanner_.move_to(start + word.size());
        }
        if (scanner_.at_line_end() || !scanner_.take(':')) fail();
    }

    /// Seconds for each of so many frames: the times of all are to be single precision, as characters' files have them.
    double read_frame_time(std::int64_t frames) {
        constexpr double least = std::numeric_limits<float>::min(), most = std::numeric_limits<float>::max();
        const char* const start = scanner_.position();
        const double seconds = read_number("frame time");
        if (!(seconds > 0)) scanner_.fail_at(start, "the frame time is not above zero");
        if (seconds < least) scanner_.fail_at(start, "the frame time is too small");
        if (seconds > most / static_cast<double>(std::max<std::int64_t>(frames, 1)))
            scanner_.fail_at(start, "the frame time is too large");
        return seconds;
    }

    void read_motion() {
        expect_title({"Frames"});
        const std::int64_t count = scanner_.whole_integer("number of frames");
        expect_title({"Frame", "Time"});
        clip_.seconds_per_frame = read_frame_time(count);
        if (channels_ == 0) scanner_.fail("no joint has a channel: nothing moves");
        // Each number takes two bytes at least: what is promised beyond that must not be made room for.
        const std::size_t most = (scanner_.bytes_left() + 1) / 2 / channels_;
        if (count < 1 || static_cast<std::uint64_t>(count) > most)
            scanner_.fail(count < 1 ? std::string("there are no frames")
                                    : "there are fewer numbers than " + std::to_string(count) + " frames take");
        if (count > most_frames) scanner_.fail("there are more than " + std::to_string(most_frames) + " frames");
        clip_.frames.resize(count, static_cast<Eigen::Index>(channels_));
        for (Eigen::Index i = 0; i < clip_.frames.size(); ++i) clip_.frames.data()[i] = read_number("channel's value");
        if (scanner_.seek_word())
            scanner_.fail("there are more numbers than " + std::to_string(count) + " frames take");
    }

    /// A joint whose closing brace has not come yet.
    struct OpenJoint {
        int index;
        bool has_offset = false, has_channels = false;
    };

    detail::TextScanner scanner_;
    std::string_view word_; ///< the last that `next_word` read
    const char* word_start_ = nullptr;
    std::vector<OpenJoint> open_;
    std::size_t channels_ = 0;
    MotionClip clip_;
};

/// The positions of a joint and the offsets that they may have in them: columns of the frames.
struct PositionColumn {
    Eigen::Index column;
    double offset;
};

std::vector<std::vector<PositionColumn>> position_columns(const MotionClip& clip) {
    std::vector<std::vector<PositionColumn>> out(clip.joints.size());
    Eigen::Index column = 0;
    for (std::size_t j = 0; j < clip.joints.size(); ++j)
        for (const ClipChannel channel : clip.joints[j].channels) {
            if (channel <= ClipChannel::z_position)
                out[j].push_back({column, clip.joints[j].offset[static_cast<int>(channel)]});
            ++column;
        }
    return out;
}

/// Some programs write positions that stand for a joint's offset, others those that come on top of it. Of joints below
/// the root, whose bones keep about their length, they are nearer to the offset or nearer to zero: most joints decide.
/// The root's only say where all of it is.
MotionClip with_offsets_in_positions(MotionClip clip) {
    const auto columns = position_columns(clip);
    int on_top = 0;
    for (std::size_t j = 1; j < columns.size(); ++j) {
        double to_zero = 0, to_offset = 0;
        for (const auto& [column, offset] : columns[j]) {
            to_zero += clip.frames.col(column).squaredNorm();
            to_offset += (clip.frames.col(column).array() - offset).matrix().squaredNorm();
        }
        on_top += to_zero < to_offset ? 1 : to_zero > to_offset ? -1 : 0;
    }
    if (on_top > 0)
        for (std::size_t j = 1; j < columns.size(); ++j)
            for (const auto& [column, offset] : columns[j]) clip.frames.col(column).array() += offset;
    return clip;
}

} // namespace

MotionClip parse_bvh(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3); // the byte order mark that some editors write
    std::string converted;
    text = detail::with_line_feeds(text, converted);
    return with_offsets_in_positions(BvhParser(text).parse());
}

MotionClip read_bvh(const std::filesystem::path& path) { return parse_bvh(read_file(path)); }

} // namespace skelgen::io
