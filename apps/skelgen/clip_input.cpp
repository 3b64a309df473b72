#include "clip_input.hpp"

#include <utility>

#include <skelgen/applications/clip_body.hpp>
#include <skelgen/applications/finger_bones.hpp>
#include <skelgen/applications/retarget.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/io/read_clip.hpp>

#include "console.hpp"

namespace skelgen::cli {

ClipInput load_clip(const std::filesystem::path& file) {
    return in_file(file, [&] {
        ClipInput input{file, io::read_clip(file, true)};
        if (const auto body = applications::find_body(input.clip); !body)
            throw Error(ErrorCode::bad_input, body.failure().what);
        return input;
    });
}

applications::Animation<double> follow_clip(const ClipInput& input, const applications::Rig<double>& rig) {
    return in_file(input.file, [&] {
        const SkeletonTemplate& human = builtin_template("human21");
        auto followed =
            applications::retarget(input.clip, applications::without_finger_bones(rig, human.joints.size()), human);
        if (!followed) throw Error(ErrorCode::bad_input, followed.failure().what);
        followed->name = input.file.stem().string();
        return applications::with_held_fingers(*std::move(followed), rig);
    });
}

} // namespace skelgen::cli
