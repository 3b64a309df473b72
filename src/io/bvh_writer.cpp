#include <skelgen/io/bvh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <skelgen/core/error.hpp>

#include "number_text.hpp"

namespace skelgen::io {
namespace {

using applications::ClipJoint;
using applications::MotionClip;

/// The lines of a joint and of all below it, and which numbers of a frame are theirs.
class BvhWriter {
public:
    explicit BvhWriter(const MotionClip& clip) : clip_(&clip), children_(clip.joints.size()) {
        std::size_t column = 0;
        for (std::size_t j = 0; j < clip.joints.size(); ++j) {
            first_column_.push_back(column);
            column += clip.joints[j].channels.size();
            if (const int parent = clip.joints[j].parent; parent >= 0)
                children_[static_cast<std::size_t>(parent)].push_back(j);
        }
    }

    std::string write() {
        text_ = "HIERARCHY\n";
        append_joint(0, "");
        text_ += "MOTION\nFrames: " + std::to_string(clip_->frames.rows()) + "\nFrame Time: ";
        detail::append_number(text_, clip_->seconds_per_frame);
        text_ += '\n';
        for (Eigen::Index frame = 0; frame < clip_->frames.rows(); ++frame) append_frame(frame);
        return text_;
    }

private:
    void append_offset(const std::string& indent, const Vector3<double>& offset) {
        text_ += indent + "OFFSET ";
        detail::append_point(text_, offset);
        text_ += '\n';
    }

    void append_channels(const std::string& indent, std::size_t j) {
        constexpr std::array<const char*, 6> names{" Xposition", " Yposition", " Zposition",
                                                   " Xrotation", " Yrotation", " Zrotation"};
        const ClipJoint& joint = clip_->joints[j];
        text_ += indent + "CHANNELS " + std::to_string(joint.channels.size());
        for (std::size_t i = 0; i < joint.channels.size(); ++i) {
            text_ += names.at(static_cast<std::size_t>(joint.channels[i]));
            columns_.push_back(static_cast<Eigen::Index>(first_column_[j] + i));
        }
        text_ += '\n';
    }

    void append_joint(std::size_t j, const std::string& indent) {
        const ClipJoint& joint = clip_->joints[j];
        const std::string inner = indent + "\t";
        text_ += indent + (joint.parent < 0 ? "ROOT " : "JOINT ") + joint.name + "\n" + indent + "{\n";
        append_offset(inner, joint.offset);
        append_channels(inner, j);
        for (const std::size_t child : children_[j]) append_joint(child, inner);
        if (joint.end) {
            text_ += inner + "End Site\n" + inner + "{\n";
            append_offset(inner + "\t", *joint.end);
            text_ += inner + "}\n";
        }
        text_ += indent + "}\n";
    }

    void append_frame(Eigen::Index frame) {
        for (const Eigen::Index column : columns_) {
            detail::append_number(text_, clip_->frames(frame, column));
            text_ += ' ';
        }
        text_.back() = '\n';
    }

    const MotionClip* clip_;
    std::vector<std::vector<std::size_t>> children_;
    std::vector<std::size_t> first_column_; ///< of a frame, per joint
    std::vector<Eigen::Index> columns_;     ///< of a frame, in the order of the lines
    std::string text_;
};

} // namespace

std::string clip_to_bvh(const MotionClip& clip) {
    validate(clip);
    const auto roots =
        std::count_if(clip.joints.begin(), clip.joints.end(), [](const ClipJoint& joint) { return joint.parent < 0; });
    if (roots != 1) throw Error(ErrorCode::usage, "a clip needs one root, not " + std::to_string(roots));
    return BvhWriter(clip).write();
}

} // namespace skelgen::io
