#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

#include <nanobind/eigen/dense.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <skelgen/applications/alignment.hpp>
#include <skelgen/applications/correspondence.hpp>
#include <skelgen/applications/measurement.hpp>
#include <skelgen/applications/pose_transfer.hpp>
#include <skelgen/applications/retarget.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/applications/segmentation.hpp>
#include <skelgen/core/join_curves.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/coloured_ply.hpp>
#include <skelgen/io/correspondence_json.hpp>
#include <skelgen/io/curve_formats.hpp>
#include <skelgen/io/measurements_text.hpp>
#include <skelgen/io/part_looks.hpp>
#include <skelgen/io/polygon_mesh.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/io/scene_looks.hpp>
#include <skelgen/io/segmentation_json.hpp>
#include <skelgen/io/transform_json.hpp>
#include <skelgen/io/write_mesh.hpp>
#include <skelgen/version.hpp>

#include <character.hpp>
#include <clip_input.hpp>
#include <compared_file.hpp>
#include <mesh_input.hpp>
#include <program.hpp>

#include "found_body.hpp"
#include "interruptible.hpp"

namespace skelgen::python {
namespace {

namespace fs = std::filesystem;
using applications::RestPose;
using Found = std::shared_ptr<FoundBody>;
using Labels = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 1>;
using Turns = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
using Pairs = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 2, Eigen::RowMajor>;
using Colours = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

Labels to_labels(const std::vector<int>& labels) {
    return Eigen::Map<const Labels>(labels.data(), static_cast<Eigen::Index>(labels.size()));
}

/// What the file's name is to be put in front of.
template <typename Work>
auto in_file(const fs::path& file, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code(), file.string() + ": " + error.what());
    }
}

/// Does the work that writes a file. \throws Error not_written where its folder is not there or closed.
template <typename Work>
void store(const fs::path& file, const Work& work) {
    interruptible([=] {
        in_file(file, [&] {
            const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
            if (::access(folder.c_str(), W_OK) != 0)
                throw Error(ErrorCode::not_written,
                            "cannot be written: its folder: " + std::generic_category().message(errno));
            work();
        });
        return true;
    });
}

// ------------------------------------------------------------------------------------------------------------- meshes

/// Where a mesh comes from: a file, and of a scene in it the animation and the time that pose it.
using Scene = std::tuple<fs::path, std::string, double>;

cli::MeshInput input_of(const Scene& scene) {
    const auto& [file, animation, time] = scene;
    return {file, {.animation = animation, .time = time, .isolated = true}};
}

std::pair<Points<double>, Triangles> read(const Scene& scene) {
    return interruptible([=] {
        return in_file(std::get<0>(scene), [&] {
            auto mesh = cli::load_mesh(input_of(scene));
            return std::pair(std::move(mesh.vertices), std::move(mesh.faces));
        });
    });
}

/// Which vertices and faces of its mesh something has; both empty: all.
using Sources = std::pair<Labels, Labels>;

Sources sources_of(const applications::OwnPart& part) { return {to_labels(part.vertices), to_labels(part.faces)}; }

/// The looks of the scene that something is of; none where they cannot be read.
io::SceneLooks looks_of(const std::optional<Scene>& scene, const applications::OwnPart& part) {
    if (!scene) return {};
    return io::looks_of(cli::keep_looks(input_of(*scene)).looks, part);
}

/// `turns`: what each vertex has been turned by since the scene was read, quaternions; none: not at all.
void write(const fs::path& file, const Vertices& vertices, const Faces& faces, const std::optional<Scene>& scene,
           const Sources& sources, const std::optional<Turns>& turns) {
    store(file, [=] {
        const LentMesh mesh(vertices, faces);
        applications::VertexTurns<double> turned(scene ? static_cast<std::size_t>((*mesh).vertices.rows()) : 0,
                                                 Eigen::Quaterniond::Identity());
        for (std::size_t v = 0; turns && v < turned.size(); ++v)
            turned[v].coeffs() = turns->row(static_cast<Eigen::Index>(v));
        const auto& [own_vertices, own_faces] = sources;
        const applications::OwnPart part{
            {own_faces.begin(), own_faces.end()}, {own_vertices.begin(), own_vertices.end()}, own_faces.size() == 0};
        io::write_mesh(file, *mesh, looks_of(scene, part), turned);
    });
}

Triangles triangulated(const Vertices& vertices, const std::vector<int>& corners, const std::vector<int>& sizes) {
    return interruptible([=] {
        io::PolygonMesh polygons{{vertices.data(), vertices.data() + vertices.size()}, corners, sizes};
        return io::cut_polygons(polygons).triangles;
    });
}

void write_text(const fs::path& file, const std::string& text) {
    store(file, [=] { io::write_file_atomically(file, text); });
}

// ------------------------------------------------------------------------------------------------------------- curves

/// Nodes, edges, radii, regions.
using CurveArrays = std::tuple<Points<double>, Pairs, Eigen::VectorXd, std::vector<Labels>>;

CurveArrays arrays_of(const CurveSkeleton<double>& curve) {
    Pairs edges(static_cast<Eigen::Index>(curve.edges.size()), 2);
    for (std::size_t e = 0; e < curve.edges.size(); ++e)
        edges.row(static_cast<Eigen::Index>(e)) << curve.edges[e][0], curve.edges[e][1];
    std::vector<Labels> regions;
    for (const std::vector<int>& region : curve.regions) regions.push_back(to_labels(region));
    return {curve.nodes, std::move(edges),
            Eigen::Map<const Eigen::VectorXd>(curve.radii.data(), static_cast<Eigen::Index>(curve.radii.size())),
            std::move(regions)};
}

CurveSkeleton<double> curve_of(const CurveArrays& arrays) {
    const auto& [nodes, edges, radii, regions] = arrays;
    CurveSkeleton<double> curve;
    curve.nodes = nodes;
    for (Eigen::Index e = 0; e < edges.rows(); ++e) curve.edges.push_back({edges(e, 0), edges(e, 1)});
    curve.radii.assign(radii.begin(), radii.end());
    for (const Labels& region : regions) curve.regions.emplace_back(region.begin(), region.end());
    return curve;
}

curve::Detail detail_named(const std::string& name) {
    if (name == "limbs") return curve::Detail::limbs;
    if (name == "digits") return curve::Detail::digits;
    if (name == "all") return curve::Detail::all;
    throw Error(ErrorCode::usage, "detail: '" + name + "' is none of limbs, digits, all");
}

CurveArrays find_curve(const Vertices& vertices, const Faces& faces, const std::string& detail,
                       std::optional<double> spacing, int threads) {
    ExtractOptions options;
    options.curve.detail = detail_named(detail);
    options.threads = threads;
    if (spacing) options.curve.centring.spacing = *spacing;
    return interruptible([=] {
        const LentMesh mesh(vertices, faces);
        std::vector<CurveSkeleton<double>> curves;
        for (auto& result : find_curves(*mesh, options)) curves.push_back(std::move(result.curve));
        return arrays_of(core::joined(curves));
    });
}

// ------------------------------------------------------------------------------------------------------- applications

Found extract(const Vertices& vertices, const Faces& faces, const std::string& name, const std::string& wanted,
              const std::string& fingers, bool toes, int component, int threads, bool with_curve, double read_ms) {
    const FindOptions options{name, wanted, fingers, toes, component, threads, with_curve, read_ms};
    return interruptible([=] { return std::make_shared<FoundBody>(vertices, faces, options); });
}

applications::PartSet part_set_named(const std::string& name) {
    if (name == "bones") return applications::PartSet::bones;
    if (name == "body") return applications::PartSet::body;
    throw Error(ErrorCode::usage, "parts: '" + name + "' is none of bones, body");
}

std::string segment(const Found& found, const std::string& parts) {
    const applications::PartSet set = part_set_named(parts);
    return interruptible([=] {
        const LentMesh mesh(found->vertices(), found->faces());
        const auto own = applications::segment(found->body(), found->skeleton(), set);
        return io::segmentation_to_json(applications::to_input(own, found->body(), *mesh), found->source(),
                                        found->skeleton().quality);
    });
}

std::string measure(const Found& found) {
    return interruptible([=] {
        const auto parts = applications::segment(found->body(), found->skeleton());
        return io::measurements_to_json({{found->source(), found->skeleton().quality,
                                          applications::measure(found->body(), found->skeleton(), parts)}});
    });
}

std::string correspond(const Found& from, const Found& to) {
    return interruptible([=] {
        const LentMesh from_mesh(from->vertices(), from->faces()), to_mesh(to->vertices(), to->faces());
        const auto from_own = from->own_part(), to_own = to->own_part();
        const auto side = [](const FoundBody& found, const TriangleMesh<double>& mesh,
                             const std::optional<cli::FittedFile>& own) {
            return cli::ComparedBody{found.source(), found.skeleton().quality, mesh,
                                     found.body(),   found.comparable(),       own ? &*own : nullptr};
        };
        const cli::CorrespondenceExtras all{true, true};
        return io::correspondence_to_json(
            cli::correspondence_of(side(*from, *from_mesh, from_own), side(*to, *to_mesh, to_own), all).file);
    });
}

/// What is written of a body: its mesh, or what of that is the chosen one of several.
struct Written {
    explicit Written(const FoundBody& found)
        : all(found.vertices(), found.faces()), own(found.own_part()), mesh(own ? own->mesh() : *all),
          body(own ? own->found : found.found()), part(own ? own->part : applications::OwnPart{}) {}

    LentMesh all;
    std::optional<cli::FittedFile> own;
    const TriangleMesh<double>& mesh;
    const Extraction<double>& body;
    applications::OwnPart part;
};

/// The transform, the vertices moved by it, and what they are of the mesh.
using AlignedArrays = std::tuple<Eigen::Matrix4d, Points<double>, Sources>;

AlignedArrays align(const Found& found, const std::string& origin, bool scale) {
    applications::AlignmentOptions options;
    if (origin == "floor")
        options.origin = applications::AlignedOrigin::floor;
    else if (origin != "crotch")
        throw Error(ErrorCode::usage, "origin: '" + origin + "' is none of crotch, floor");
    return interruptible([=]() mutable {
        const Written own(*found);
        const Points<double>& vertices = own.mesh.vertices;
        if (scale) options.scale = 1 / applications::standing_height(own.body.body, found->skeleton());
        const Eigen::Matrix4d transform = applications::alignment(own.body.body, found->skeleton(), vertices, options);
        return AlignedArrays{transform, applications::transformed(vertices, transform), sources_of(own.part)};
    });
}

/// Vertices, what each was turned by, what they are of the mesh, and the skeleton's file of a body held as a model.
using PosedArrays = std::tuple<Points<double>, Turns, Sources, std::string>;

/// Where the model stands on a floor, so does the body.
PosedArrays posed(const Found& found, const KinematicSkeleton<double>& model,
                  const std::optional<applications::Floor<double>>& floor) {
    const Written own(*found);
    auto held = applications::pose_like(own.mesh, own.body.body, found->skeleton(), model, found->skeleton_template());
    if (floor) held = applications::put_on(std::move(held), *floor);
    Turns turns(static_cast<Eigen::Index>(held.turns.size()), 4);
    for (std::size_t v = 0; v < held.turns.size(); ++v)
        turns.row(static_cast<Eigen::Index>(v)) = held.turns[v].coeffs();
    return {std::move(held.mesh.vertices), std::move(turns), sources_of(own.part), skeleton_to_json(held.skeleton)};
}

PosedArrays pose_like(const Found& found, const Found& model) {
    return interruptible([=] {
        const LentMesh mesh(model->vertices(), model->faces());
        const auto floor = applications::floor_of(*mesh, model->skeleton(), model->skeleton_template());
        return posed(found, model->skeleton(), floor.is_stood_on ? std::optional(floor) : std::nullopt);
    });
}

PosedArrays pose_as(const Found& found, const std::string& skeleton) {
    return interruptible([=] {
        const KinematicSkeleton<double> model = io::parse_skeleton_document(skeleton).skeleton;
        const bool has_bones = std::any_of(model.joints.begin(), model.joints.end(), [&](const Joint<double>& joint) {
            return joint.parent >= 0 && joint.position != model.joints[static_cast<std::size_t>(joint.parent)].position;
        });
        if (!has_bones) throw Error(ErrorCode::bad_input, "like: the skeleton's bones have no length");
        return posed(found, model, std::nullopt);
    });
}

// --------------------------------------------------------------------------------------------------------- characters

/// A rig with what it looks like and how it moves.
struct Character {
    applications::Rig<double> rig;
    SkeletonTemplate skeleton_template;
    applications::OwnPart part; ///< of the mesh, what this is
    io::SceneLooks looks;
    std::vector<applications::Animation<double>> animations;
};

RestPose rest_named(const std::string& name) {
    if (name == "as-is") return RestPose::as_is;
    if (name == "t-pose") return RestPose::t_pose;
    if (name == "a-pose") return RestPose::a_pose;
    throw Error(ErrorCode::usage, "rest: '" + name + "' is none of as-is, t-pose, a-pose");
}

std::shared_ptr<Character> make_rig(const Found& found, const std::string& rest, const std::string& fingers, bool toes,
                                    const std::optional<Scene>& scene) {
    const RestPose pose = rest_named(rest);
    const cli::Fingers wanted = cli::template_and_fingers("human21", fingers).second;
    return interruptible([=] {
        const Written own(*found);
        return std::make_shared<Character>(Character{cli::rig_of(own.mesh, own.body, found->skeleton_template(),
                                                                 {pose, applications::Place::keep}, wanted, toes),
                                                     found->skeleton_template(),
                                                     own.part,
                                                     looks_of(scene, own.part),
                                                     {}});
    });
}

std::shared_ptr<Character> animated(const std::shared_ptr<Character>& character, const fs::path& clip) {
    return interruptible([=] {
        const cli::ClipInput motion = cli::load_clip(clip);
        return in_file(clip, [&] {
            auto followed = applications::retarget(motion.clip, character->rig, character->skeleton_template);
            if (!followed) throw Error(ErrorCode::bad_input, followed.failure().what);
            followed->name = clip.stem().string();
            Character out = *character;
            out.animations.push_back(*std::move(followed));
            return std::make_shared<Character>(std::move(out));
        });
    });
}

void write_character(const std::shared_ptr<Character>& character, const fs::path& file, const std::string& names) {
    const auto convention = io::joint_names_named(names);
    if (!convention) {
        std::string known;
        for (const std::string& one : io::joint_names()) known += (known.empty() ? "" : ", ") + one;
        throw Error(ErrorCode::usage, "names: '" + names + "' is none of " + known);
    }
    store(file, [=] {
        if (character->animations.empty()) {
            write_rig(file, character->rig, *convention, character->looks);
        } else {
            const auto format = io::rig_format_of(file);
            if (format != io::RigFormat::glb && format != io::RigFormat::fbx)
                throw Error(ErrorCode::usage, "a moving character's name must end in .glb or .fbx");
            const auto write = format == io::RigFormat::fbx ? io::rig_to_fbx : io::rig_to_glb;
            io::write_file_atomically(file,
                                      write(character->rig, *convention, character->looks, character->animations));
        }
    });
}

Points<double> joint_positions(const Character& character) {
    Points<double> out(static_cast<Eigen::Index>(character.rig.joints.size()), 3);
    for (Eigen::Index j = 0; j < out.rows(); ++j)
        out.row(j) = character.rig.joints[static_cast<std::size_t>(j)].position;
    return out;
}

// ------------------------------------------------------------------------------------------------------------- colours

Colours part_colours(const std::vector<std::string>& parts) {
    const auto colours = io::part_colours(parts);
    Colours out(static_cast<Eigen::Index>(colours.size()), 3);
    for (std::size_t p = 0; p < colours.size(); ++p)
        out.row(static_cast<Eigen::Index>(p)) << colours[p][0], colours[p][1], colours[p][2];
    return out;
}

void write_parts(const fs::path& file, const Vertices& vertices, const Faces& faces,
                 const std::vector<std::string>& parts, const std::vector<int>& vertex_part,
                 const std::vector<int>& face_part) {
    store(file, [=] {
        const LentMesh mesh(vertices, faces);
        io::MeshColours colours{{}, vertex_part, face_part};
        const auto palette = io::part_colours(parts);
        for (const int part : vertex_part) colours.vertices.push_back(palette.at(static_cast<std::size_t>(part)));
        io::write_coloured_ply(file, *mesh, colours);
    });
}

// ------------------------------------------------------------------------------------------------------------- program

/// The program, in a process that does nothing else; arguments as the system gives them, without the program's name.
int run_program(const std::vector<nb::bytes>& arguments) {
    std::vector<std::string> texts{"skelgen"};
    for (const nb::bytes& argument : arguments) texts.emplace_back(argument.c_str(), argument.size());
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return cli::run_program(static_cast<int>(texts.size()), pointers.data());
}

// -------------------------------------------------------------------------------------------------------------- errors

void raise(PyObject* type, const Error& error) { PyErr_SetString(type, error.what()); }

void translate(const std::exception_ptr& thrown, void*) {
    try {
        std::rethrow_exception(thrown);
    } catch (const Error& error) {
        switch (error.code()) {
        case ErrorCode::no_skeleton: {
            const nb::object raised = no_skeleton_error(error);
            return PyErr_SetObject(raised.type().ptr(), raised.ptr());
        }
        case ErrorCode::usage:
        case ErrorCode::bad_input:
            return raise(PyExc_ValueError, error);
        case ErrorCode::not_written:
            return raise(PyExc_OSError, error);
        case ErrorCode::internal:
            break;
        }
        raise(PyExc_RuntimeError, error);
    }
}

} // namespace

NB_MODULE(_core, m) {
    nb::register_exception_translator(translate);
    nb::set_leak_warnings(false); // what is abandoned by Ctrl-C may stay until the end
    m.attr("version") = std::string(version);
    m.def("leave_abandoned", &leave_abandoned);
    m.def("builtin_template_names", &builtin_template_names);
    m.def("mesh_extensions",
          [] { return std::vector<std::string>(io::mesh_extensions().begin(), io::mesh_extensions().end()); });
    m.def("read", &read, nb::arg("scene"));
    m.def("write", &write, nb::arg("file"), nb::arg("vertices"), nb::arg("faces"), nb::arg("scene").none(),
          nb::arg("sources"), nb::arg("turns").none());
    m.def("triangulated", &triangulated, nb::arg("vertices"), nb::arg("corners"), nb::arg("sizes"));
    m.def("write_text", &write_text, nb::arg("file"), nb::arg("text"));
    m.def("find_curve", &find_curve, nb::arg("vertices"), nb::arg("faces"), nb::arg("detail"),
          nb::arg("spacing").none(), nb::arg("threads"));
    m.def("curve_to_json", [](const CurveArrays& curve) { return io::curve_to_json(curve_of(curve)); });
    m.def("write_curve", [](const fs::path& file, const CurveArrays& curve) {
        store(file, [=] { io::write_curve(file, curve_of(curve)); });
    });
    nb::class_<FoundBody>(m, "FoundBody")
        .def_prop_ro("skeleton_json", &FoundBody::skeleton_json)
        .def_prop_ro("trail_json", &FoundBody::trail_json)
        .def_prop_ro("curve", [](const FoundBody& found) { return arrays_of(found.curve()); });
    m.def("extract", &extract, nb::arg("vertices"), nb::arg("faces"), nb::arg("name"), nb::arg("template"),
          nb::arg("fingers"), nb::arg("toes"), nb::arg("component"), nb::arg("threads"), nb::arg("with_curve"),
          nb::arg("read_ms"));
    m.def("skeleton_json", [](const std::string& text) {
        const auto document = io::parse_skeleton_document(text);
        return skeleton_to_json(document.skeleton, document.provenance);
    });
    m.def("segment", &segment, nb::arg("found"), nb::arg("parts"));
    m.def("measure", &measure, nb::arg("found"));
    m.def("align", &align, nb::arg("found"), nb::arg("origin"), nb::arg("scale"));
    m.def("transform_to_json", &io::transform_to_json, nb::arg("matrix"));
    m.def("correspond", &correspond, nb::arg("source"), nb::arg("target"));
    m.def("pose_like", &pose_like, nb::arg("found"), nb::arg("model"));
    m.def("pose_as", &pose_as, nb::arg("found"), nb::arg("skeleton"));
    m.def("part_colours", &part_colours, nb::arg("parts"));
    m.def("write_parts", &write_parts, nb::arg("file"), nb::arg("vertices"), nb::arg("faces"), nb::arg("parts"),
          nb::arg("vertex_part"), nb::arg("face_part"));
    nb::class_<Character>(m, "Character")
        .def_prop_ro("vertices", [](const Character& c) { return c.rig.mesh.vertices; })
        .def_prop_ro("faces", [](const Character& c) { return c.rig.mesh.faces; })
        .def_prop_ro("sources", [](const Character& c) { return sources_of(c.part); })
        .def_prop_ro("names",
                     [](const Character& c) {
                         std::vector<std::string> names;
                         for (const auto& joint : c.rig.joints) names.push_back(joint.name);
                         return names;
                     })
        .def_prop_ro("parents",
                     [](const Character& c) {
                         std::vector<int> parents;
                         for (const auto& joint : c.rig.joints) parents.push_back(joint.parent);
                         return to_labels(parents);
                     })
        .def_prop_ro("positions", &joint_positions)
        .def_prop_ro("joints", [](const Character& c) { return c.rig.skin.joints; })
        .def_prop_ro("weights", [](const Character& c) { return c.rig.skin.weights; })
        .def_prop_ro("metres_per_unit", [](const Character& c) { return c.rig.metres_per_unit; })
        .def_prop_ro("unit_is_known", [](const Character& c) { return c.rig.unit_is_known; })
        .def_prop_ro("animations", [](const Character& c) {
            std::vector<std::string> names;
            for (const auto& animation : c.animations) names.push_back(animation.name);
            return names;
        });
    m.def("make_rig", &make_rig, nb::arg("found"), nb::arg("rest"), nb::arg("fingers"), nb::arg("toes"),
          nb::arg("scene").none());
    m.def("animated", &animated, nb::arg("character"), nb::arg("clip"));
    m.def("run_program", &run_program, nb::arg("arguments"));
    m.def("write_character", &write_character, nb::arg("character"), nb::arg("file"), nb::arg("names"));
}

} // namespace skelgen::python
