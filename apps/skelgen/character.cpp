#include "character.hpp"

#include <utility>

#include "console.hpp"
#include "fitted_file.hpp"
#include "own_part.hpp"

namespace skelgen::cli {

Character make_character(const MeshInput& input, const CharacterOptions& options) {
    ExtractOptions extraction;
    extraction.prepare.component = options.component;
    FittedFile body = fit_file(input, extraction);
    const OwnPart part = options.component > 0 ? keep_own_part(body) : OwnPart{};
    KeptLooks kept = keep_looks(input);
    kept.looks = looks_of(kept.looks, part);
    const SkeletonTemplate& skeleton_template = builtin_template(body.skeleton().template_name);
    return {applications::make_rig(body.mesh, body.found.body, body.skeleton(), skeleton_template, options.rest),
            std::move(kept), body.skeleton()};
}

void print_warnings(const std::filesystem::path& file, const Character& character) {
    print_warnings(file, character.skeleton);
    if (!character.kept.warning.empty()) print_warning(file.string() + ": " + character.kept.warning);
    if (!character.rig.unit_is_known)
        print_warning(file.string() + ": its unit is unknown, as it has no person's height in any; " +
                      "lengths are left as they are");
}

void add_joint_names_option(CLI::App& command, std::string& names, const std::string& help) {
    command.add_option("--names", names, help)
        ->check(CLI::IsMember({"skelgen", "smpl", "mixamo", "vrm"}))
        ->capture_default_str();
}

} // namespace skelgen::cli
