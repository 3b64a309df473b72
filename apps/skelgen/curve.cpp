#include <memory>

#include <skelgen/extract.hpp>
#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "commands.hpp"
#include "console.hpp"

namespace skelgen::cli {
namespace {

struct CurveCommand {
    std::string mesh;
    std::string output;
};

void run(const CurveCommand& command) {
    require_different_files(command.mesh, command.output);
    const CurveSkeleton<double> curve =
        in_file(command.mesh, [&] { return find_curve_skeleton(read_mesh<double>(command.mesh)); });
    if (command.output == "-") return write_result("-", io::curve_to_json(curve));
    in_file(command.output, [&] { write_curve(command.output, curve); });
}

} // namespace

void add_curve_command(CLI::App& app) {
    auto command = std::make_shared<CurveCommand>();
    CLI::App* sub = app.add_subcommand("curve", "Find the curve skeleton alone, of a body or anything else");
    sub->add_option("MESH", command->mesh, "Mesh: OFF, OBJ, PLY or STL")->required();
    sub->add_option("-o,--output", command->output,
                    "File to write: .json, .obj (lines), .ply or .swc; - for JSON on standard output")
        ->required();
    sub->footer("Example:\n  skelgen curve body.off -o body-curve.obj");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
