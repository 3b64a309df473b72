#include <memory>
#include <utility>
#include <vector>

#include <skelgen/core/join_curves.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/curve_formats.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "mesh_input.hpp"
#include "number_range.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

struct CurveCommand {
    MeshInput mesh;
    std::string output;
    double spacing = curve::BranchCentringOptions().spacing;
    std::string detail = "limbs";
};

/// `name` is one of those that the command line lets through.
curve::Detail parse_detail(const std::string& name) {
    if (name == "digits") return curve::Detail::digits;
    if (name == "all") return curve::Detail::all;
    return curve::Detail::limbs;
}

ExtractOptions extract_options(const CurveCommand& command) {
    ExtractOptions options;
    options.curve.centring.spacing = command.spacing;
    options.curve.detail = parse_detail(command.detail);
    return options;
}

/// Tells of which components there is no curve, or one that may be off the middle.
void print_warnings(const std::string& mesh, const std::vector<curve::CurveResult<double>>& results) {
    for (std::size_t i = 0; i < results.size(); ++i) {
        const std::string component = "component " + std::to_string(i + 1) + " of " + std::to_string(results.size());
        if (results[i].is_point)
            print_warning(mesh + ": " + component + " is too compact for a curve: its centre is given");
        else if (!results[i].converged)
            print_warning(mesh + ": " + component +
                          ": the contraction did not converge; the curve may leave the middle");
    }
}

void run(const CurveCommand& command) {
    const std::string file = command.mesh.file.string();
    require_different_files(file, command.output);
    require_folder_of(command.output);
    auto results = in_file(file, [&] {
        const WaitingLine waiting(file, true);
        return find_curves(load_mesh(command.mesh), extract_options(command));
    });
    std::vector<CurveSkeleton<double>> curves;
    for (auto& result : results) curves.push_back(std::move(result.curve));
    const CurveSkeleton<double> curve = core::joined(curves);
    if (command.output == "-")
        write_result("-", io::curve_to_json(curve));
    else
        in_file(command.output, [&] { write_curve(command.output, curve); });
    print_warnings(file, results);
}

} // namespace

void add_curve_command(CLI::App& app) {
    auto command = std::make_shared<CurveCommand>();
    CLI::App* sub = app.add_subcommand("curve", "Find the curve skeleton alone, of a body or anything else");
    add_mesh_input(*sub, command->mesh, "Mesh, of which each component gets a curve");
    sub->add_option("-o,--output", command->output,
                    "File to write: .json, .obj (lines), .ply or .swc; - for JSON on standard output")
        ->required();
    sub->add_option("--spacing", command->spacing,
                    "Distance between nodes along the curve, relative to the diagonal of the mesh's bounding box")
        ->check(number_range(0.0005, 1))
        ->capture_default_str();
    sub->add_option("--detail", command->detail,
                    "limbs: trunk and limbs (5 ends on a body); digits: also fingers, tails, horns, table legs; "
                    "all: everything that sticks out")
        ->check(CLI::IsMember({"limbs", "digits", "all"}))
        ->capture_default_str();
    sub->footer("Example:\n  skelgen curve body.off -o body-curve.obj\n"
                "  skelgen curve hand.ply -o hand.swc --detail digits --spacing 0.005");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
