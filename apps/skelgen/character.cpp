#include "character.hpp"

#include <utility>

#include <skelgen/applications/finger_bones.hpp>
#include <skelgen/hands/find_hands.hpp>
#include <skelgen/io/part_looks.hpp>

#include "console.hpp"
#include "fitted_file.hpp"

namespace skelgen::cli {

applications::Rig<double> rig_of(const FittedFile& body, const SkeletonTemplate& skeleton_template,
                                 applications::RestPose rest, Fingers fingers) {
    auto rig = applications::make_rig(body.mesh(), body.found.body, body.skeleton(), skeleton_template, rest);
    if (fingers == Fingers::off) return rig;
    auto hands = hands::find_hands(body.mesh(), body.found.body, body.skeleton());
    if (fingers == Fingers::automatic) std::erase_if(hands, [](const auto& hand) { return hand.digits.size() < 2; });
    return applications::with_finger_bones(std::move(rig), body.mesh(), body.skeleton(), skeleton_template, hands);
}

Character make_character(const MeshInput& input, const CharacterOptions& options) {
    ExtractOptions extraction;
    extraction.prepare.component = options.component;
    FittedFile body = fit_file(input, extraction);
    if (options.component > 0) body = with_own_part(std::move(body));
    KeptLooks kept = keep_looks(input);
    kept.looks = io::looks_of(kept.looks, body.part);
    auto rig = rig_of(body, builtin_template(body.skeleton().template_name), options.rest, options.fingers);
    return {std::move(rig), std::move(kept), body.skeleton()};
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
