#include "clip_input.hpp"

#include <utility>

#include <skelgen/applications/retarget.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/io/bvh.hpp>

#include "console.hpp"

namespace skelgen::cli {

applications::Animation<double> follow_clip(const std::filesystem::path& file, const applications::Rig<double>& rig) {
    return in_file(file, [&] {
        auto followed = applications::retarget(read_bvh(file), rig, builtin_template("human21"));
        if (!followed) throw Error(ErrorCode::bad_input, followed.failure().what);
        followed->name = file.stem().string();
        return *std::move(followed);
    });
}

} // namespace skelgen::cli
