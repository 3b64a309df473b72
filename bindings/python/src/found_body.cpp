#include "found_body.hpp"

#include <skelgen/core/parallel.hpp>
#include <skelgen/io/template_json.hpp>

namespace skelgen::python {
namespace {

Extraction<double> found_in(const Vertices& vertices, const Faces& faces, const SkeletonTemplate& wanted,
                            const FindOptions& options) {
    ExtractOptions how;
    how.skeleton_template = wanted;
    how.prepare.component = options.component;
    how.threads = options.threads;
    how.with_curve = options.with_curve;
    const LentMesh mesh(vertices, faces);
    return extract_in(*mesh, how);
}

/// What was tried, with the keys of trail files.
nb::list listed(const Trail& trail) {
    nb::list out;
    for (const search::Tried& tried : trail) {
        const search::Hypothesis& what = tried.hypothesis;
        nb::dict entry;
        entry["surface"] = std::string(search::to_string(what.surface));
        entry["opened"] = std::string(search::to_string(what.opening));
        entry["cuts"] = what.cuts;
        entry["held"] = std::string(search::to_string(what.held));
        entry["lacking"] = tried.lacks_limb;
        entry["curve"] = std::string(search::to_string(what.effort));
        entry["outcome"] = tried.candidates > 0 ? std::string("found") : std::string(to_string(tried.refusal));
        entry["probability"] = tried.probability;
        entry["seconds"] = tried.seconds;
        out.append(entry);
    }
    return out;
}

} // namespace

FoundBody::FoundBody(const Vertices& vertices, const Faces& faces, const FindOptions& options)
    : vertices_(vertices), faces_(faces), template_(io::load_template(options.skeleton_template)),
      found_(found_in(vertices, faces, template_, options)), source_{options.name,
                                                                     static_cast<std::int64_t>(vertices.shape(0)),
                                                                     static_cast<std::int64_t>(faces.shape(0)),
                                                                     found_.geodesic_diameter},
      read_ms_(options.read_ms) {}

std::string FoundBody::skeleton_json() const {
    io::FileTimings timings{read_ms_, found_.timings};
    timings.stages.total += read_ms_;
    return skeleton_to_json(skeleton(), {source_, timings});
}

const applications::ComparableBody<double>& FoundBody::comparable() const {
    const std::lock_guard lock(mutex_);
    if (!comparable_)
        comparable_ =
            std::make_unique<const applications::ComparableBody<double>>(applications::comparable(body(), skeleton()));
    return *comparable_;
}

nb::list trail_of(const FoundBody& body) { return listed(body.trail()); }

nb::object no_skeleton_error(const Error& error) {
    const auto* refused = dynamic_cast<const NoSkeleton*>(&error); // others: a skeleton that does not lie in its body
    const std::string code(error.refusal() == Refusal::none ? "no_skeleton" : to_string(error.refusal()));
    return nb::module_::import_("skelgen._errors")
        .attr("NoSkeletonError")(error.what(), code, refused ? listed(refused->trail()) : nb::list());
}

} // namespace skelgen::python
