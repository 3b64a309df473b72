#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/correspondence.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/io/coloured_ply.hpp>
#include <skelgen/io/correspondence_json.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "fitted_file.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

struct CorrespondCommand {
    fs::path from, to;
    std::string output = "-";
    std::string ply; ///< folder
    bool confidence = false;
    bool quiet = false;
};

/// One of the two bodies.
struct ComparedFile : FittedFile {
    applications::ComparableBody<double> body;
    std::vector<int> stands_for; ///< per vertex of the mesh that of the body
};

ComparedFile load(const fs::path& file) {
    return in_file(file, [&] {
        ComparedFile out{fit_file({file, {}}), {}, {}};
        out.body = applications::comparable(out.found.body, out.skeleton());
        out.stands_for = applications::standing_for(out.found.body, out.mesh.vertices);
        return out;
    });
}

/// For each vertex of a body one of its mesh that is at its place, or near it where the body has vertices of its own.
std::vector<int> mesh_vertices(const ComparedFile& file) {
    std::vector<int> out = applications::first_standing(file.found.body, file.stands_for);
    for (std::size_t v = 0; v < out.size(); ++v)
        if (out[v] < 0)
            out[v] = core::nearest_vertex(file.mesh, file.found.body.similarity.to_input(core::point(
                                                         file.found.body.mesh.vertices, static_cast<Eigen::Index>(v))));
    return out;
}

/// Each vertex in the colour of its place in the common pose: x red, y green, z blue.
std::vector<io::ByteColour> place_colours(const applications::ComparableBody<double>& body) {
    const Eigen::RowVector3d low = body.common.colwise().minCoeff();
    const Eigen::RowVector3d extent = body.common.colwise().maxCoeff() - low;
    std::vector<io::ByteColour> out;
    for (Eigen::Index v = 0; v < body.common.rows(); ++v) {
        io::ByteColour colour{};
        for (int axis = 0; axis < 3; ++axis)
            colour[static_cast<std::size_t>(axis)] =
                static_cast<std::uint8_t>(40 + 215 * (body.common(v, axis) - low[axis]) / extent[axis]);
        out.push_back(colour);
    }
    return out;
}

/// Where the two bodies go in colours.
std::array<fs::path, 2> coloured_files(const CorrespondCommand& command) {
    return {fs::path(command.ply) / "from.ply", fs::path(command.ply) / "to.ply"};
}

void write_coloured(const CorrespondCommand& command, const ComparedFile& from, const ComparedFile& to,
                    const std::vector<int>& to_body_of_from) {
    make_folder(command.ply);
    const std::vector<io::ByteColour> places = place_colours(to.body);
    const auto write = [&](const fs::path& file, const TriangleMesh<double>& mesh, const std::vector<int>& place_of) {
        io::MeshColours colours;
        for (const int place : place_of) colours.vertices.push_back(places[static_cast<std::size_t>(place)]);
        in_file(file, [&] { io::write_coloured_ply(file, mesh, colours); });
    };
    const auto [from_file, to_file] = coloured_files(command);
    write(from_file, from.mesh, to_body_of_from);
    write(to_file, to.mesh, to.stands_for);
}

void run(const CorrespondCommand& command) {
    if (command.from == "-" && command.to == "-")
        throw Error(ErrorCode::usage, "two bodies cannot both come through standard input");
    std::vector<std::string> outputs{command.output};
    if (!command.ply.empty())
        for (const fs::path& file : coloured_files(command)) outputs.push_back(file.string());
    for (const std::string& output : outputs)
        for (const fs::path& input : {command.from, command.to}) require_different_files(input, output);
    require_folder_of(command.output);
    WaitingLine waiting(command.from.string() + " and " + command.to.string(), !command.quiet);
    const ComparedFile from = load(command.from), to = load(command.to);
    const applications::Correspondence found = applications::correspond(from.body, to.body);
    const std::vector<int> to_mesh = mesh_vertices(to), from_mesh = mesh_vertices(from);
    io::CorrespondenceFile file{from.source, to.source, from.skeleton().quality, to.skeleton().quality, {}, {}, {}};
    std::vector<int> to_body_of_from;
    for (const int v : from.stands_for) {
        to_body_of_from.push_back(found.map[static_cast<std::size_t>(v)]);
        file.vertex_to_vertex.push_back(to_mesh[static_cast<std::size_t>(to_body_of_from.back())]);
        if (command.confidence) file.confidence.push_back(found.confidence[static_cast<std::size_t>(v)]);
    }
    for (const applications::Landmark& landmark : applications::landmarks(from.body, found))
        file.landmarks.push_back({landmark.name, from_mesh[static_cast<std::size_t>(landmark.from)],
                                  to_mesh[static_cast<std::size_t>(landmark.to)]});
    waiting.end();
    if (!command.ply.empty()) write_coloured(command, from, to, to_body_of_from);
    write_result(command.output, io::correspondence_to_json(file));
    if (command.quiet) return;
    print_warnings(command.from, from.skeleton());
    print_warnings(command.to, to.skeleton());
}

} // namespace

void add_correspond_command(CLI::App& app) {
    auto command = std::make_shared<CorrespondCommand>();
    CLI::App* sub = app.add_subcommand("correspond", "Find for each vertex of one body the same place on another one");
    sub->add_option("FROM", command->from, "Mesh of one body, any format that is read; - for standard input")
        ->required();
    sub->add_option("TO", command->to, "Mesh of another one, or of the same in another pose")->required();
    sub->add_option("-o,--output", command->output, "File to write (JSON): a vertex of TO for each of FROM")
        ->capture_default_str();
    sub->add_option("--ply", command->ply, "Folder for both bodies (from.ply, to.ply), like places in like colours");
    sub->add_flag("--confidence", command->confidence, "Also how sure each vertex's place is, 0 to 1");
    sub->add_flag("-q,--quiet", command->quiet, "No warnings");
    sub->footer("Example:\n  skelgen correspond child.ply adult.obj -o map.json --ply coloured/");
    sub->callback([command] { run(*command); });
}

} // namespace skelgen::cli
