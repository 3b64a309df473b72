#include "character.hpp"

#include <sstream>
#include <utility>

#include <skelgen/applications/finger_bones.hpp>
#include <skelgen/hands/find_hands.hpp>
#include <skelgen/io/part_looks.hpp>

#include "console.hpp"
#include "fitted_file.hpp"

namespace skelgen::cli {
namespace {

std::string number_text(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

} // namespace

applications::Rig<double> rig_of(const TriangleMesh<double>& mesh, const Extraction<double>& found,
                                 const SkeletonTemplate& skeleton_template, const applications::RigOptions& options,
                                 Fingers fingers, bool toes) {
    auto rig = applications::make_rig(mesh, found.body, found.skeleton, skeleton_template, options);
    std::vector<hands::Hand<double>> hands;
    if (fingers != Fingers::off) hands = hands::find_hands(mesh, found.body, found.skeleton);
    if (fingers == Fingers::automatic) std::erase_if(hands, [](const auto& hand) { return hand.digits.size() < 2; });
    if (toes)
        for (auto& foot : hands::find_feet(mesh, found.body, found.skeleton)) hands.push_back(std::move(foot));
    if (hands.empty()) return rig;
    return applications::with_finger_bones(std::move(rig), mesh, found.skeleton, skeleton_template, hands);
}

Character make_character(const MeshInput& input, const CharacterOptions& options) {
    ExtractOptions extraction;
    extraction.prepare.component = options.component;
    FittedFile body = fit_file(input, extraction);
    if (options.component > 0) body = with_own_part(std::move(body));
    KeptLooks kept = keep_looks(input);
    kept.looks = io::looks_of(kept.looks, body.part);
    auto rig = rig_of(body.mesh(), body.found, builtin_template(body.skeleton().template_name), options.rig,
                      options.fingers, options.toes);
    return {std::move(rig), std::move(kept), body.skeleton(), body.found.body.repairs};
}

std::string left_out_text(io::RigFormat format, const io::SceneLooks& looks) {
    std::string text;
    for (const std::string& one : io::left_out_of(format, looks)) text += (text.empty() ? "left out: " : ", ") + one;
    return text;
}

void print_forbidden(const std::filesystem::path& file, const io::SceneLooks& looks) {
    if (looks.forbidden.empty()) return;
    print_warning(file.string() + ": ITS LICENCE FORBIDS " + looks.forbidden +
                  ": ask its authors before you use or pass on what is written here, which has the same licence");
}

void print_warnings(const std::filesystem::path& file, const Character& character, io::RigFormat format, bool quiet) {
    print_forbidden(file, character.kept.looks);
    print_warnings(file, character.skeleton, character.repairs, words_of(quiet));
    if (quiet) return;
    if (const std::string lost = left_out_text(format, character.kept.looks); !lost.empty())
        print_warning(file.string() + ": " + lost);
    if (!character.kept.warning.empty()) print_warning(file.string() + ": " + character.kept.warning);
    if (!character.rig.unit_is_known)
        print_warning(file.string() +
                      ": its unit is unknown, since in none it is as high as a person; lengths stay as they " +
                      "are, unless you give --unit");
    else if (character.rig.metres_per_unit != 1)
        print_note(file.string() + ": its unit is " + number_text(character.rig.metres_per_unit) +
                   " m; what is written is in metres");
}

void add_bone_options(CLI::App& command, BoneOptions& options) {
    command
        .add_option("--bones", options.bones,
                    "plain; engine: also clavicles, an upper chest and a root on the floor below the hips")
        ->check(CLI::IsMember({"plain", "engine"}))
        ->capture_default_str();
    command.add_flag("--twist", options.twist, "Also bones that halve the twist of upper arms, forearms and thighs");
}

void add_digit_options(CLI::App& command, DigitOptions& options) {
    command.add_option("--fingers", options.fingers, "Bones of the fingers: where the surface shows some, or none")
        ->check(CLI::IsMember({"auto", "off", "on"}))
        ->capture_default_str();
    command.add_flag("--toes", options.toes, "Also bones of the single toes, where the surface shows them");
}

void add_joint_names_option(CLI::App& command, std::string& names, const std::string& help) {
    command.add_option("--names", names, help)->check(CLI::IsMember(io::joint_names()))->capture_default_str();
}

} // namespace skelgen::cli
