#include <memory>

#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "mesh_input.hpp"

namespace skelgen::cli {
namespace {

struct ConvertCommand {
    MeshInput mesh;
    std::string output;
};

void run(const ConvertCommand& command) {
    require_different_files(command.mesh.file, command.output);
    require_folder_of(command.output);
    const auto format = io::mesh_format_of(command.output);
    if (!format || !io::is_written(*format))
        throw Error(ErrorCode::usage, command.output + ": its name must end in " + io::written_mesh_extensions_text());
    const TriangleMesh<double> mesh = in_file(command.mesh.file, [&] { return load_mesh(command.mesh); });
    const KeptLooks kept = keep_looks(command.mesh);
    const applications::VertexTurns<double> as_it_is(static_cast<std::size_t>(mesh.vertices.rows()),
                                                     Eigen::Quaterniond::Identity());
    in_file(command.output, [&] { io::write_mesh(command.output, mesh, kept.looks, as_it_is); });
    print_lost_looks(command.mesh.file, kept, *format);
}

} // namespace

void add_convert_command(CLI::App& app) {
    auto command = std::make_shared<ConvertCommand>();
    CLI::App* sub =
        app.add_subcommand("convert", "Write a mesh, or a scene's meshes as they are shown, in another format");
    add_mesh_input(*sub, command->mesh, "Mesh to read");
    sub->add_option("-o,--output,OUT", command->output, "Mesh to write: " + io::written_mesh_extensions_text())
        ->required();
    sub->footer("Examples:\n  skelgen convert character.glb character.ply\n"
                "  skelgen convert character.glb walking.obj --animation walk --time 0.5\n"
                "  xz -dc body.off.xz | skelgen convert - body.glb");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
