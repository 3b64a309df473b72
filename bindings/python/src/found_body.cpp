#include "found_body.hpp"

#include <string>
#include <utility>

#include <skelgen/core/parallel.hpp>
#include <skelgen/io/template_json.hpp>
#include <skelgen/io/trail_json.hpp>

namespace skelgen::python {
namespace {

/// `wanted`: a template's name or file, or auto: a person's or a four-legged animal's, whichever is likelier.
Extraction<double> found_in(const TriangleMesh<double>& mesh, const std::string& wanted, const FindOptions& options) {
    ExtractOptions how;
    how.or_quadruped = wanted == "auto";
    try {
        how.skeleton_template = io::load_template(how.or_quadruped ? "human21" : wanted);
    } catch (const Error& error) {
        throw Error(error.code(), std::string("template: ") + error.what());
    }
    how.prepare.component = options.component;
    how.threads = options.threads;
    how.with_curve = options.with_curve;
    return extract_in(mesh, how);
}

} // namespace

FoundBody::FoundBody(const Vertices& vertices, const Faces& faces, const FindOptions& options)
    : vertices_(vertices), faces_(faces), read_ms_(options.read_ms), component_(options.component) {
    const auto [named, fingers] = cli::template_and_fingers(options.skeleton_template, options.fingers, options.toes);
    const LentMesh mesh(vertices, faces);
    found_ = found_in(*mesh, named, options);
    template_ = found_.skeleton_template;
    const core::ThreadScope threads(options.threads);
    shown_ = cli::with_fingers(*mesh, found_, fingers, options.toes);
    source_ = {options.name, (*mesh).vertices.rows(), (*mesh).faces.rows(), found_.geodesic_diameter};
}

std::string FoundBody::skeleton_json() const {
    io::FileTimings timings{read_ms_, found_.timings};
    timings.stages.total += read_ms_;
    return skeleton_to_json(shown_.skeleton, {source_, timings, shown_.fused});
}

std::string FoundBody::trail_json() const { return io::trail_to_json(found_.trail); }

std::optional<cli::FittedFile> FoundBody::own_part() const {
    if (component_ == 0) return std::nullopt;
    cli::FittedFile all{found_, source_};
    all.found.mesh = *LentMesh(vertices_, faces_);
    return cli::with_own_part(std::move(all));
}

const applications::ComparableBody<double>& FoundBody::comparable() const {
    const std::lock_guard lock(mutex_);
    if (!comparable_)
        comparable_ =
            std::make_unique<const applications::ComparableBody<double>>(applications::comparable(body(), skeleton()));
    return *comparable_;
}

nb::object no_skeleton_error(const Error& error) {
    const auto* refused = dynamic_cast<const NoSkeleton*>(&error); // others: a skeleton that does not lie in its body
    const std::string code(error.refusal() == Refusal::none ? "no_skeleton" : to_string(error.refusal()));
    return nb::module_::import_("skelgen._errors")
        .attr("NoSkeletonError")
        .attr("_of")(error.what(), code.c_str(), io::trail_to_json(refused ? refused->trail() : Trail{}).c_str());
}

} // namespace skelgen::python
