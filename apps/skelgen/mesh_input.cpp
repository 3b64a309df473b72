#include "mesh_input.hpp"

#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/read_file.hpp>

#include "console.hpp"
#include "number_range.hpp"

namespace skelgen::cli {
namespace {

constexpr const char* standard_input = "-";

/// Read once: the mesh and its looks are both in it.
const std::string& standard_input_content() {
    static const std::string content = io::read_file("/dev/stdin");
    return content;
}

std::vector<std::string> format_names() {
    std::vector<std::string> names;
    for (const std::string_view extension : io::mesh_extensions()) names.emplace_back(extension.substr(1));
    return names;
}

constexpr const char* all = "all";

CLI::Validator component_number(bool takes_all) {
    const CLI::Range range(1, 1000);
    const auto check = [=](const std::string& text) -> std::string {
        if (text != all) return range(text);
        return takes_all ? "" : "all: what is written is of one body; take each by its number";
    };
    return CLI::Validator(check, range.get_description() + (takes_all ? " or all" : ""));
}

/// "2 pictures are left out: why; and others"; empty where nothing is.
std::string what_is_lost(const std::vector<std::string>& lost, const std::string& one, const std::string& several) {
    if (lost.empty()) return "";
    const bool is_one = lost.size() == 1;
    return std::to_string(lost.size()) + " " + (is_one ? one + " is" : several + " are") +
           " left out: " + lost.front() + (is_one ? "" : "; and others");
}

} // namespace

void add_mesh_input(CLI::App& command, MeshInput& input, const std::string& help) {
    command
        .add_option("MESH", input.file,
                    help + " (" + io::mesh_extensions_text() + ", also .gz of each); - for standard input")
        ->required();
    command
        .add_option_function<std::string>(
            "--format", [&input](const std::string& name) { input.options.format = io::mesh_format_named(name); },
            "Format of the mesh, where neither its content nor its name tells")
        ->check(CLI::IsMember(format_names(), CLI::ignore_case));
    CLI::Option* animation = command.add_option(
        "--animation", input.options.animation,
        "Pose a scene by its animation of this name or number (from 1); else it is posed as it is stored");
    command.add_option("--time", input.options.time, "Seconds from the animation's beginning")
        ->needs(animation)
        ->check(number_range(-1e9, 1e9))
        ->capture_default_str();
}

void add_component_option(CLI::App& command, int& component, const std::string& name, const std::string& help) {
    command.add_option(name, component, help)->check(component_number(false));
}

void add_components_option(CLI::App& command, int& component) {
    command
        .add_option_function<std::string>(
            "--component",
            [&component](const std::string& text) { component = text == all ? all_components : std::stoi(text); },
            "Which of several bodies that stand apart; 1 is the largest; all: each, as if it were a mesh of its own,\n"
            "called NAME.1, NAME.2 and so on")
        ->check(component_number(true));
}

void add_skeleton_option(CLI::App& command, std::filesystem::path& skeleton) {
    command.add_option("--skeleton", skeleton,
                       "Take this skeleton of the mesh (JSON, as extract writes it), put right by hand perhaps, and\n"
                       "search for none");
}

void add_wanted_option(CLI::App& command, std::string& wanted) {
    command
        .add_option(
            "--template", wanted,
            "What is looked for: human21, a person; quadruped, a four-legged animal; auto, the likelier of both")
        ->check(CLI::IsMember({"human21", "quadruped", "auto"}))
        ->capture_default_str();
}

void add_skeleton_options(CLI::App& command, MeshInput& input) {
    add_skeleton_option(command, input.skeleton);
    command
        .add_flag("--use-rig", input.use_rig,
                  "Take the joints of the file's own rig where they lie in the body, and say how far off those are\n"
                  "that are found without it")
        ->excludes("--skeleton");
}

TriangleMesh<double> load_mesh(const MeshInput& input) {
    io::ReadMeshOptions options = input.options;
    options.tell = [&](const std::string& what) { print_warning(input.file.string() + ": " + what); };
    if (input.file != standard_input) return read_mesh<double>(input.file, options);
    return io::parse_mesh<double>(standard_input_content(), options);
}

io::SceneLooks load_looks(const MeshInput& input) {
    auto looks = input.file == standard_input ? io::parse_looks(standard_input_content(), input.options)
                                              : io::read_looks(input.file, input.options);
    return std::move(looks).value_or(io::SceneLooks{});
}

KeptLooks keep_looks(const MeshInput& input) {
    try {
        KeptLooks kept{load_looks(input), ""};
        const std::string pictures = what_is_lost(kept.looks.lost_pictures, "picture", "pictures");
        kept.warning =
            what_is_lost(kept.looks.lost_materials, "material or file of materials", "materials or files of materials");
        if (!kept.warning.empty() && !pictures.empty()) kept.warning += "; ";
        kept.warning += pictures;
        return kept;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::bad_input) throw;
        return {{}, std::string("its looks are left out: ") + error.what()};
    }
}

void print_lost_looks(const std::filesystem::path& file, const KeptLooks& kept, io::MeshFormat format) {
    const io::SceneLooks& looks = kept.looks;
    std::string lost;
    const auto add = [&](const std::string& what) { lost += (lost.empty() ? "left out: " : ", ") + what; };
    if (format != io::MeshFormat::glb && format != io::MeshFormat::fbx) {
        if (const std::size_t morphs = io::morph_target_count(looks); morphs > 0)
            add(std::to_string(morphs) + " morph targets (.glb and .fbx keep them)");
    } else if (!kept.warning.empty()) {
        lost = kept.warning + (looks.left_out.empty() ? "" : "; ");
    }
    for (const std::string& one : looks.left_out) add(one);
    if (!lost.empty()) print_warning(file.string() + ": " + lost);
}

} // namespace skelgen::cli
