// What JavaScript calls. Files are in the memory's file system; skelgen.mjs puts them there and makes of what comes
// back what users see. Every function returns an object: either with the result or with "error".
#include <algorithm>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <skelgen/applications/bone_sections.hpp>
#include <skelgen/applications/clip_body.hpp>
#include <skelgen/applications/finger_bones.hpp>
#include <skelgen/applications/measurement.hpp>
#include <skelgen/applications/own_part.hpp>
#include <skelgen/applications/retarget.hpp>
#include <skelgen/applications/segmentation.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/extract_hinted.hpp>
#include <skelgen/fit_skeleton.hpp>
#include <skelgen/hands/find_hands.hpp>
#include <skelgen/io/bvh.hpp>
#include <skelgen/io/measurements_text.hpp>
#include <skelgen/io/part_looks.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/io/skeleton_json.hpp>
#include <skelgen/io/trail_json.hpp>
#include <skelgen/io/view_page.hpp>
#include <skelgen/io/write_mesh.hpp>
#include <skelgen/version.hpp>

#include <character.hpp>
#include <extract_file.hpp>
#include <fitted_file.hpp>
#include <mesh_input.hpp>

namespace skelgen::wasm {
namespace {

using emscripten::typed_memory_view;
using emscripten::val;
namespace fs = std::filesystem;

// -------------------------------------------------------------------------------------------------------------- arrays

/// A typed array of JavaScript's own with a copy: views of the memory are lost where that grows.
template <typename Number>
val copied(const char* type, const Number* data, std::size_t size) {
    return val::global(type).new_(val(typed_memory_view(size, data)));
}

val bytes_of(const std::string& text) {
    return copied("Uint8Array", reinterpret_cast<const unsigned char*>(text.data()), text.size());
}

val array_of(const Points<double>& points) {
    return copied("Float64Array", points.data(), static_cast<std::size_t>(points.size()));
}

val array_of(const Triangles& faces) {
    return copied("Uint32Array", reinterpret_cast<const unsigned*>(faces.data()),
                  static_cast<std::size_t>(faces.size()));
}

val array_of(const std::vector<int>& numbers) { return copied("Int32Array", numbers.data(), numbers.size()); }

template <typename Number>
val filled(const char* type, const std::vector<Number>& numbers) {
    return copied(type, numbers.data(), numbers.size());
}

/// The entries are the caller's array's, converted as JavaScript does.
template <typename Matrix>
void fill(Matrix& matrix, const val& array) {
    val(typed_memory_view(static_cast<std::size_t>(matrix.size()), matrix.data())).call<void>("set", array);
}

// -------------------------------------------------------------------------------------------------------------- errors

/// Thrown where the caller does not want the result any longer.
struct Cancelled {};

val failed(std::string_view code, const std::string& message) {
    val error = val::object();
    error.set("code", std::string(code));
    error.set("message", message);
    val out = val::object();
    out.set("error", error);
    return out;
}

/// What `work` returns, or what it throws: no exception leaves for JavaScript, which would know its address alone.
template <typename Work>
val answered(const Work& work) {
    try {
        return work();
    } catch (const NoSkeleton& refused) {
        val out = failed("no_skeleton", refused.what());
        out["error"].set("refusal", std::string(to_string(refused.refusal())));
        out["error"].set("trail", io::trail_to_json(refused.trail()));
        return out;
    } catch (const Error& error) {
        val out = failed(to_string(error.code()), error.what());
        if (error.refusal() != Refusal::none) out["error"].set("refusal", std::string(to_string(error.refusal())));
        return out;
    } catch (const Cancelled&) {
        return failed("cancelled", "cancelled");
    } catch (const std::bad_alloc&) {
        return failed("out_of_memory", "needs more memory than a page may have; simplify the mesh first");
    } catch (const std::exception& error) {
        return failed("internal", std::string("a fault of skelgen's own, please report it: ") + error.what());
    }
}

val done() { return val::object(); }

// -------------------------------------------------------------------------------------------------------------- meshes

/// A mesh, with the file that it is from; that one has its looks.
class Mesh {
public:
    explicit Mesh(const std::string& path) : file_(path) {}

    [[nodiscard]] const TriangleMesh<double>& mesh() const { return mesh_; }
    [[nodiscard]] const fs::path& file() const { return file_; }
    [[nodiscard]] cli::MeshInput input() const {
        cli::MeshInput input{file_, {}};
        input.options.isolated = false; // what would be read in a process of its own is read by nothing here
        return input;
    }

    val read() {
        return answered([&] {
            mesh_ = cli::load_mesh(input());
            kept_ = cli::keep_looks(input());
            return done();
        });
    }

    /// Takes vertices and faces as they are.
    val take(const val& positions, const val& faces) {
        return answered([&] {
            mesh_.vertices.resize(positions["length"].as<Eigen::Index>() / 3, 3);
            mesh_.faces.resize(faces["length"].as<Eigen::Index>() / 3, 3);
            fill(mesh_.vertices, positions);
            fill(mesh_.faces, faces);
            return done();
        });
    }

    val positions() const { return array_of(mesh_.vertices); }
    val faces() const { return array_of(mesh_.faces); }
    const cli::KeptLooks& looks() const { return kept_; }

    /// As a page shows a mesh without a skeleton: GLB.
    val glb() const {
        return answered([&] {
            val out = val::object();
            out.set("bytes", bytes_of(io::format_mesh(mesh_, io::MeshFormat::glb)));
            return out;
        });
    }

private:
    fs::path file_;
    TriangleMesh<double> mesh_;
    cli::KeptLooks kept_;
};

// -------------------------------------------------------------------------------------------------------------- bodies

std::string text_in(const val& options, const char* name, const std::string& otherwise) {
    const val value = options[name];
    return value.isUndefined() || value.isNull() ? otherwise : value.as<std::string>();
}

std::vector<Hint> hints_in(const val& options) {
    std::vector<Hint> hints;
    const val given = options["hints"];
    if (given.isUndefined() || given.isNull()) return hints;
    const val names = val::global("Object").call<val>("keys", given);
    for (unsigned i = 0; i < names["length"].as<unsigned>(); ++i) {
        Hint hint;
        hint.joint = names[i].as<std::string>();
        for (int axis = 0; axis < 3; ++axis) hint.position[axis] = given[hint.joint][axis].as<double>();
        hints.push_back(std::move(hint));
    }
    return hints;
}

cli::Fingers fingers_in(const val& options, const std::string& otherwise) {
    return cli::template_and_fingers("human21", text_in(options, "fingers", otherwise)).second;
}

bool toes_in(const val& options) { return options["toes"].isTrue(); }

/// A mesh bound to its skeleton.
class Character {
public:
    Character(applications::Rig<double> rig, io::SceneLooks looks, std::string lost)
        : rig_(std::move(rig)), looks_(std::move(looks)), lost_(std::move(lost)) {}

    /// A file of the format ("glb", ...) with the joints named by a convention; `stem`: what a VRM is called.
    val file(const std::string& format, const std::string& names, const std::string& stem, bool with_animations) const {
        return answered([&] {
            const auto convention = io::joint_names_named(names);
            if (!convention) throw Error(ErrorCode::usage, "names: '" + names + "' is no convention that is known");
            const auto wanted = io::rig_format_of("." + format == ".vrm" ? stem + ".vrm" : "rig." + format);
            if (!wanted) throw Error(ErrorCode::usage, "format: '" + format + "' is none of glb, vrm, fbx, bvh");
            val out = val::object();
            out.set("bytes", bytes_of(text_of(*wanted, *convention, stem, with_animations)));
            std::string left_out = cli::left_out_text(*wanted, looks_);
            out.set("leftOut", left_out);
            return out;
        });
    }

    /// Has it follow the clip in a file, as `stem` in its own list of animations.
    val follow(const std::string& path, const std::string& name) {
        return answered([&] {
            const auto clip = io::read_bvh(path);
            if (const auto body = applications::find_body(clip); !body)
                throw Error(ErrorCode::bad_input, body.failure().what);
            const auto& human = builtin_template("human21");
            auto followed =
                applications::retarget(clip, applications::without_finger_bones(rig_, human.joints.size()), human);
            if (!followed) throw Error(ErrorCode::bad_input, followed.failure().what);
            followed->name = name;
            std::erase_if(animations_, [&](const auto& one) { return one.name == name; });
            animations_.push_back(applications::with_held_fingers(*std::move(followed), rig_));
            return done();
        });
    }

    val positions() const { return array_of(rig_.mesh.vertices); }
    val faces() const { return array_of(rig_.mesh.faces); }
    val skin_joints() const {
        const auto& joints = rig_.skin.joints;
        std::vector<unsigned short> out(joints.data(), joints.data() + joints.size());
        return filled("Uint16Array", out);
    }
    val skin_weights() const {
        const auto& weights = rig_.skin.weights;
        std::vector<float> out(static_cast<std::size_t>(weights.size()));
        std::transform(weights.data(), weights.data() + weights.size(), out.begin(),
                       [](double weight) { return static_cast<float>(weight); });
        return filled("Float32Array", out);
    }
    /// Name, parent, side, place, end of the bone and confidence of each joint; and, of the skeleton's own, the motion
    /// from the mesh, in metres, to the rig: a quaternion and a translation.
    val joints() const {
        val out = val::array();
        for (std::size_t j = 0; j < rig_.joints.size(); ++j) {
            const auto& joint = rig_.joints[j];
            val one = val::object();
            one.set("name", joint.name);
            one.set("parent", joint.parent);
            one.set("side", std::string(joint.side == Side::left    ? "left"
                                        : joint.side == Side::right ? "right"
                                                                    : "none"));
            one.set("position", array_of(Points<double>(joint.position.transpose())));
            one.set("end", array_of(Points<double>(joint.end.transpose())));
            one.set("confidence", joint.confidence);
            if (j < rig_.motions.size()) {
                const auto& [rotation, translation] = rig_.motions[j];
                const std::vector<double> motion{rotation.x(),   rotation.y(),   rotation.z(),  rotation.w(),
                                                 translation[0], translation[1], translation[2]};
                one.set("motion", filled("Float64Array", motion));
            }
            out.call<void>("push", one);
        }
        return out;
    }
    double metres_per_unit() const { return rig_.metres_per_unit; }
    bool unit_is_known() const { return rig_.unit_is_known; }
    std::string lost_looks() const { return lost_; }
    std::string forbidden() const { return looks_.forbidden; }
    bool has_looks() const {
        return looks_.json.find("\"materials\"") != std::string::npos ||
               std::any_of(looks_.parts.begin(), looks_.parts.end(),
                           [](const io::ScenePart& part) { return part.colours.rows() > 0; });
    }

private:
    std::string text_of(io::RigFormat format, io::JointNames names, const std::string& stem,
                        bool with_animations) const {
        const auto& animations = with_animations ? animations_ : no_animations_;
        switch (format) {
        case io::RigFormat::glb:
            return io::rig_to_glb(rig_, names, looks_, animations);
        case io::RigFormat::vrm:
            return io::rig_to_vrm(rig_, stem, looks_);
        case io::RigFormat::fbx:
            return io::rig_to_fbx(rig_, names, looks_, animations);
        case io::RigFormat::bvh:
            break;
        }
        return io::rig_to_bvh(rig_, names);
    }

    applications::Rig<double> rig_;
    io::SceneLooks looks_;
    std::string lost_;
    std::vector<applications::Animation<double>> animations_;
    const std::vector<applications::Animation<double>> no_animations_;
};

/// A body that was found in a mesh, with that mesh.
class FoundBody {
public:
    explicit FoundBody(std::string name) : name_(std::move(name)) {}

    /// `before_try`: called with what is spent of the budget, and the budget; ends the search where it returns true.
    val find(Mesh& mesh, const val& options, const val& before_try) {
        return answered([&] {
            take_looks(mesh);
            const auto [wanted, fingers] = cli::template_and_fingers(
                text_in(options, "template", "human21"), text_in(options, "fingers", "off"), toes_in(options));
            ExtractOptions how = options_of(options);
            how.skeleton_template = builtin_template(wanted);
            how.with_curve = options["curve"].isTrue();
            if (!before_try.isUndefined())
                how.before_try = [&](int spent, int budget) {
                    if (before_try(spent, budget).as<bool>()) throw Cancelled();
                };
            const std::vector<Hint> hints = hints_in(options);
            file_.found = hints.empty() ? extract_in(mesh.mesh(), how) : extract_hinted(mesh.mesh(), hints, how);
            finish(mesh, how.prepare.component, fingers, toes_in(options));
            return done();
        });
    }

    /// With a skeleton that is known: the text of its file.
    val fit(const Mesh& mesh, const std::string& skeleton, const val& options) {
        return answered([&] {
            take_looks(mesh);
            const ExtractOptions how = options_of(options);
            file_.found =
                fit_skeleton(mesh.mesh(), hands::without_digits(io::parse_skeleton_document(skeleton).skeleton), how);
            file_.found.skeleton.quality.sides_confidence = 1; // who gives a skeleton answers for it
            finish(mesh, how.prepare.component, fingers_in(options, "off"), toes_in(options));
            return done();
        });
    }

    std::string skeleton_json() const {
        io::SkeletonProvenance provenance{file_.source, std::nullopt, shown_.fused};
        provenance.timings_ms = io::FileTimings{0, file_.found.timings};
        return skeleton_to_json(shown_.skeleton, provenance);
    }
    std::string trail_json() const { return io::trail_to_json(file_.found.trail); }
    val repairs() const {
        val out = val::array();
        for (const std::string& repair : file_.found.body.repairs) out.call<void>("push", repair);
        return out;
    }

    val curve() const {
        const auto& curve = file_.found.curve;
        std::vector<int> edges;
        for (const auto& edge : curve.edges) edges.insert(edges.end(), {edge[0], edge[1]});
        val out = val::object();
        out.set("nodes", array_of(curve.nodes));
        out.set("edges", array_of(edges));
        out.set("radii", filled("Float64Array", curve.radii));
        return out;
    }

    val segment(const std::string& parts) const {
        return answered([&] {
            const bool is_body = parts == "body";
            if (!is_body && parts != "bones")
                throw Error(ErrorCode::usage, "parts: '" + parts + "' is none of bones, body");
            const auto set = is_body ? applications::PartSet::body : applications::PartSet::bones;
            const auto own = applications::segment(file_.found.body, file_.skeleton(), set);
            const auto all = applications::to_input(own, file_.found.body, file_.mesh());
            val names = val::array();
            for (const std::string& name : all.parts) names.call<void>("push", name);
            val out = val::object();
            out.set("parts", names);
            out.set("vertexPart", array_of(all.vertex_part));
            out.set("facePart", array_of(all.face_part));
            return out;
        });
    }

    val measure() const {
        return answered([&] {
            const auto parts = applications::segment(file_.found.body, file_.skeleton());
            val out = val::object();
            out.set("json",
                    io::measurements_to_json({{file_.source, file_.skeleton().quality,
                                               applications::measure(file_.found.body, file_.skeleton(), parts)}}));
            return out;
        });
    }

    /// \returns an object with "character", which is the caller's to delete.
    val rig(const val& options) const {
        return answered([&] {
            applications::RigOptions how{rest_named(text_in(options, "rest", "as-is")),
                                         place_named(text_in(options, "place", "keep")), metres_in(options)};
            const cli::FittedFile* body = &file_;
            std::optional<cli::FittedFile> own;
            if (component_ > 0) body = &own.emplace(cli::with_own_part(file_));
            io::SceneLooks looks = io::with_credits(
                io::looks_of(kept_.looks, body->part),
                {text_in(options, "title", ""), text_in(options, "author", ""), text_in(options, "license", "")});
            auto made = std::make_shared<Character>(cli::rig_of(body->mesh(), body->found,
                                                                builtin_template(body->skeleton().template_name), how,
                                                                fingers_in(options, "auto"), toes_in(options)),
                                                    std::move(looks), kept_.warning);
            val out = val::object();
            out.set("character", std::move(made));
            return out;
        });
    }

    /// What apps/view's modules show of a body as it is: JSON.
    val view() const {
        return answered([&] {
            io::ViewedBody body;
            body.name = name_;
            const auto& skeleton_template = builtin_template(file_.skeleton().template_name);
            body.sections = applications::bone_sections(file_.found.body, file_.skeleton(), skeleton_template);
            body.rig = applications::make_rig(file_.mesh(), file_.found.body, file_.skeleton(), skeleton_template);
            body.looks = kept_.looks;
            body.skeleton = file_.skeleton();
            body.curve = file_.found.curve;
            val out = val::object();
            out.set("json", io::viewed_body_to_json(body));
            return out;
        });
    }

private:
    static ExtractOptions options_of(const val& options) {
        ExtractOptions how;
        how.with_curve = false;
        const val component = options["component"];
        if (component.isNumber()) how.prepare.component = component.as<int>();
        return how;
    }

    static applications::RestPose rest_named(const std::string& name) {
        if (name == "as-is") return applications::RestPose::as_is;
        if (name == "t-pose") return applications::RestPose::t_pose;
        if (name == "a-pose") return applications::RestPose::a_pose;
        throw Error(ErrorCode::usage, "rest: '" + name + "' is none of as-is, t-pose, a-pose");
    }

    static applications::Place place_named(const std::string& name) {
        if (name == "keep") return applications::Place::keep;
        if (name == "centre") return applications::Place::centre;
        if (name == "floor") return applications::Place::floor;
        throw Error(ErrorCode::usage, "place: '" + name + "' is none of keep, centre, floor");
    }

    static double metres_in(const val& options) {
        const val metres = options["metresPerUnit"];
        return metres.isNumber() ? metres.as<double>() : 0;
    }

    void take_looks(const Mesh& mesh) { kept_ = mesh.looks(); }

    void finish(const Mesh& mesh, int component, cli::Fingers fingers, bool toes) {
        file_.found.mesh = mesh.mesh();
        component_ = component;
        file_.source = {name_, file_.found.mesh.vertices.rows(), file_.found.mesh.faces.rows(),
                        file_.found.geodesic_diameter};
        shown_ = cli::with_fingers(file_.mesh(), file_.found, fingers, toes);
    }

    std::string name_;
    cli::FittedFile file_;
    cli::FingeredSkeleton shown_;
    cli::KeptLooks kept_;
    int component_ = 0;
};

std::string joint_names_text() {
    std::string text;
    for (const std::string& name : io::joint_names()) text += (text.empty() ? "" : " ") + name;
    return text;
}

} // namespace

EMSCRIPTEN_BINDINGS(skelgen) {
    emscripten::function(
        "version", +[] { return std::string(version); });
    emscripten::function("jointNames", &joint_names_text);
    emscripten::class_<Mesh>("Mesh")
        .constructor<std::string>()
        .function("read", &Mesh::read)
        .function("take", &Mesh::take)
        .function("positions", &Mesh::positions)
        .function("faces", &Mesh::faces)
        .function("glb", &Mesh::glb);
    emscripten::class_<Character>("Character")
        .smart_ptr<std::shared_ptr<Character>>("CharacterPointer")
        .function("file", &Character::file)
        .function("follow", &Character::follow)
        .function("positions", &Character::positions)
        .function("faces", &Character::faces)
        .function("skinJoints", &Character::skin_joints)
        .function("skinWeights", &Character::skin_weights)
        .function("joints", &Character::joints)
        .function("metresPerUnit", &Character::metres_per_unit)
        .function("unitIsKnown", &Character::unit_is_known)
        .function("lostLooks", &Character::lost_looks)
        .function("forbidden", &Character::forbidden)
        .function("hasLooks", &Character::has_looks);
    emscripten::class_<FoundBody>("FoundBody")
        .constructor<std::string>()
        .function("find", &FoundBody::find)
        .function("fit", &FoundBody::fit)
        .function("skeletonJson", &FoundBody::skeleton_json)
        .function("trailJson", &FoundBody::trail_json)
        .function("repairs", &FoundBody::repairs)
        .function("curve", &FoundBody::curve)
        .function("segment", &FoundBody::segment)
        .function("measure", &FoundBody::measure)
        .function("rig", &FoundBody::rig)
        .function("view", &FoundBody::view);
}

} // namespace skelgen::wasm
