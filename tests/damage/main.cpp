// skelgen-damage KIND IN -o OUT, or --all IN_DIR -o OUT_DIR: writes body meshes damaged as files that people have are.
// Exit status 0: done; 1: some could not be damaged so.

#include <atomic>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "kinds.hpp"
#include "parallel.hpp"

namespace {

namespace fs = std::filesystem;
using namespace skelgen;

struct Options {
    std::string kind, input, all, output;
    std::string skeletons; ///< a file, or with `all` a folder
    std::vector<std::string> kinds;
    std::uint64_t seed = 1;
    unsigned jobs = 1;
    bool list = false;
};

damage::Subject read_subject(const fs::path& mesh, const fs::path& skeleton, std::uint64_t seed) {
    damage::Subject subject{read_mesh<double>(mesh), {}, seed};
    if (!skeleton.empty() && fs::is_regular_file(skeleton)) subject.skeleton = read_skeleton(skeleton);
    return subject;
}

/// OUT/<kind>/<path of the mesh below IN_DIR> of one mesh. \returns how many kinds could not be made of it.
int damage_in_all_ways(const Options& options, const fs::path& mesh, const std::vector<damage::Kind>& kinds) {
    const fs::path relative = mesh.lexically_relative(options.all);
    const fs::path skeleton =
        options.skeletons.empty() ? fs::path() : (fs::path(options.skeletons) / relative).replace_extension(".json");
    const damage::Subject subject = read_subject(mesh, skeleton, options.seed);
    int failed = 0;
    for (const damage::Kind& kind : kinds) try {
            const fs::path out = (fs::path(options.output) / kind.name / relative).replace_extension(kind.extension);
            fs::create_directories(out.parent_path());
            write_mesh(out, damaged(kind, subject));
        } catch (const std::exception& error) {
            std::cerr << mesh.string() + ": " + kind.name + ": " + error.what() + "\n";
            ++failed;
        }
    return failed;
}

int damage_folder(const Options& options) {
    std::vector<fs::path> meshes;
    for (const auto& entry : fs::recursive_directory_iterator(options.all))
        if (io::mesh_format_of(entry.path())) meshes.push_back(entry.path());
    std::vector<damage::Kind> kinds;
    for (const std::string& name : options.kinds) kinds.push_back(damage::named_kind(name));
    if (kinds.empty()) kinds = damage::kinds();
    std::atomic<int> failed = 0;
    test::for_each_index(meshes.size(), options.jobs,
                         [&](std::size_t i) { failed += damage_in_all_ways(options, meshes[i], kinds); });
    return failed > 0 ? 1 : 0;
}

int run(const Options& options) {
    if (options.list) {
        for (const damage::Kind& kind : damage::kinds()) std::cout << kind.name << ": " << kind.what << '\n';
        return 0;
    }
    if (options.output.empty()) throw Error(ErrorCode::usage, "name an output with -o");
    if (!options.all.empty()) return damage_folder(options);
    if (options.input.empty()) throw Error(ErrorCode::usage, "name a damage and a mesh, or a folder with --all");
    const damage::Kind& kind = damage::named_kind(options.kind);
    write_mesh(options.output, damaged(kind, read_subject(options.input, options.skeletons, options.seed)));
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Writes a body's mesh damaged as the files that people have are.", "skelgen-damage");
    app.add_option("KIND", options.kind, "The damage; see --list");
    app.add_option("IN", options.input, "A sound body's mesh");
    app.add_option("--all", options.all, "Damage every mesh below this folder in every way, into OUT/<kind>/...");
    app.add_option("-o,--output", options.output, "Mesh to write; with --all a folder");
    app.add_option("--skeleton", options.skeletons,
                   "The body's skeleton file, which some damages need; with --all a folder of them");
    app.add_option("--kinds", options.kinds, "With --all: these damages alone");
    app.add_option("--seed", options.seed, "Of all that is random")->capture_default_str();
    app.add_option("--jobs", options.jobs, "With --all: meshes at once")->check(CLI::Range(1U, 256U));
    app.add_flag("--list", options.list, "Say which damages there are");
    CLI11_PARSE(app, argc, argv);
    try {
        return run(options);
    } catch (const std::exception& error) {
        std::cerr << "skelgen-damage: error: " << error.what() << '\n';
        return 1;
    }
}
