#include <skelgen/extract.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include <skelgen/core/canonical_form.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/curve/limb_ends.hpp>
#include <skelgen/curve/manifold_parts.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/io/template_json.hpp>
#include <skelgen/refinement/settle.hpp>

namespace skelgen {
namespace {

class Stopwatch {
public:
    /// Milliseconds since the last lap.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double elapsed = std::chrono::duration<double, std::milli>(now - last_).count();
        last_ = now;
        return elapsed;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

template <typename Scalar>
void check_surface(const TriangleMesh<Scalar>& mesh) {
    if (mesh.vertices.rows() < 4 || mesh.faces.rows() < 4)
        throw Error(ErrorCode::bad_input,
                    "the mesh has fewer than four vertices or faces; a body needs a closed surface");
    if (!mesh.vertices.allFinite())
        throw Error(ErrorCode::bad_input, "the mesh has a coordinate that is not a finite number; repair it");
    if (mesh.faces.minCoeff() < 0 || mesh.faces.maxCoeff() >= mesh.vertices.rows())
        throw Error(ErrorCode::bad_input, "a face refers to a vertex that does not exist; repair the mesh");
}

/// The shape is no body's: another curve would not change that.
struct Refusal : Error {
    explicit Refusal(const std::string& what) : Error(ErrorCode::no_skeleton, what) {}
};

/// A body reaches far for its surface: toe to fingertip takes 1.34 (very heavy, or in a coat) to 1.85 times (thin) the
/// square root of its area; a ball 0.9, a dog 1.2, two people hand in hand 2.2. `diameter` is geodesic, for unit area.
void check_slender(double diameter) {
    constexpr double least = 1.26, most = 2.1;
    if (diameter < least) throw Refusal("no human body: too compact a shape for one with arms and legs");
    if (diameter > most) throw Refusal("no single human body: too thin and long a shape for one");
}

/// What goes on as far as an arm and belongs to no limb is another body's.
void check_alone(double unmatched_reach) {
    constexpr double arm = 0.17;
    if (unmatched_reach > arm)
        throw Refusal("no single human body: a limb is left over; separate bodies that are joined to others");
}

/// From the pipeline's canonical coordinates back to the caller's.
template <typename Scalar>
class BackToInput {
public:
    explicit BackToInput(const Similarity& similarity) : similarity_(similarity) {}

    [[nodiscard]] Vector3<Scalar> point(const Vector3<double>& p) const {
        return similarity_.to_input(p).template cast<Scalar>();
    }
    [[nodiscard]] Vector3<Scalar> direction(const Vector3<double>& d) const {
        return (similarity_.rotation.transpose() * d).template cast<Scalar>();
    }
    [[nodiscard]] Scalar length(double l) const { return static_cast<Scalar>(similarity_.scale * l); }

    [[nodiscard]] KinematicSkeleton<Scalar> skeleton(const KinematicSkeleton<double>& s) const {
        KinematicSkeleton<Scalar> out;
        out.template_name = s.template_name;
        for (const Joint<double>& joint : s.joints)
            out.joints.push_back(
                {joint.name, joint.parent, point(joint.position), length(joint.radius), joint.confidence});
        for (const auto& [name, p] : s.end_points) out.end_points.emplace_back(name, point(p));
        out.frame = {point(s.frame.origin), direction(s.frame.left), direction(s.frame.forward), direction(s.frame.up)};
        out.quality = s.quality;
        return out;
    }

    /// `source`: the caller's vertex behind each vertex of the regions. Where fans of faces touch, several stand for
    /// one of the caller's; it goes to the first region that has it.
    [[nodiscard]] CurveSkeleton<Scalar> curve(const CurveSkeleton<double>& c, const std::vector<int>& source) const {
        CurveSkeleton<Scalar> out;
        out.nodes.resize(c.nodes.rows(), 3);
        for (Eigen::Index v = 0; v < c.nodes.rows(); ++v)
            out.nodes.row(v) = point(c.nodes.row(v).transpose()).transpose();
        out.edges = c.edges;
        for (const double radius : c.radii) out.radii.push_back(length(radius));
        std::unordered_set<int> taken;
        for (const std::vector<int>& region : c.regions) {
            std::vector<int>& vertices = out.regions.emplace_back();
            for (const int v : region) {
                const int vertex = source[static_cast<std::size_t>(v)];
                if (taken.insert(vertex).second) vertices.push_back(vertex);
            }
        }
        return out;
    }

private:
    const Similarity& similarity_;
};

/// The first half of the pipeline: the largest piece of the mesh in canonical coordinates, and the curve within.
struct BodyCurve {
    Similarity similarity;
    ManifoldParts<double> body; ///< `source` indexes the caller's vertices
    CurveGraph<double> surface; ///< of `body`
    CurveSkeleton<double> curve;
};

template <typename Scalar>
BodyCurve find_body_curve(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    check_surface(mesh);
    const CanonicalMesh canonical = canonical_form(mesh);
    BodyCurve out{canonical.similarity, largest_manifold_part(canonical.mesh), {}, {}};
    out.surface = surface_graph(out.body.mesh);
    const Proxy proxy = build_proxy(out.body.mesh, options.proxy);
    out.curve = extract_curve(out.body.mesh, out.surface, proxy, options.curve);
    for (int& v : out.body.source) v = canonical.input_vertex[static_cast<std::size_t>(v)];
    return out;
}

/// Independent cycles of a connected curve.
int loops(const CurveSkeleton<double>& curve) {
    return static_cast<int>(curve.edges.size()) - static_cast<int>(curve.nodes.rows()) + 1;
}

/// Where limbs touch, the curve runs on from one to the other.
void doubt_loops(KinematicSkeleton<double>& skeleton, int loops) {
    constexpr double often_wrong = 0.7;
    if (loops == 0) return;
    skeleton.quality.sides_confidence *= often_wrong;
    for (Joint<double>& joint : skeleton.joints) joint.confidence *= often_wrong;
    skeleton.quality.warnings.push_back("the body touches itself: its curve skeleton has " + std::to_string(loops) +
                                        (loops == 1 ? " loop" : " loops") + ", limbs may be mistaken");
}

/// The second half of the pipeline: the template laid into the curve, and the joints that follow from it.
struct Fit {
    KinematicSkeleton<double> skeleton;
    double geodesic_diameter = 0;
    int misplaced = 0; ///< joints whose bones have unlikely lengths
};

Fit fit_skeleton(const TriangleMesh<double>& mesh, const CurveGraph<double>& surface,
                 const CurveSkeleton<double>& curve, const SkeletonTemplate& wanted, const ExtractOptions& options,
                 StageTimings& timings) {
    Stopwatch stage;
    const Embedding embedding = embed(curve, wanted, options.matching);
    check_alone(unmatched_reach(curve, embedding));
    timings.embed += stage.lap();

    Fit out;
    const std::vector<EndPoint> ends = find_end_points(mesh, surface, curve, embedding, wanted);
    out.geodesic_diameter = geodesic_diameter(ends);
    check_slender(out.geodesic_diameter);
    const RefinedJoints joints = refine(mesh, ends, curve, embedding, wanted, options.refinement);
    timings.refine += stage.lap();

    const SidesDecision sides = decide_sides(joints, wanted, options.sides);
    out.skeleton = assemble(joints, wanted, sides);
    out.misplaced = judge_joints(out.skeleton, wanted);
    move_to_bones(out.skeleton, wanted);
    balance_bones(out.skeleton, wanted);
    keep_inside(out.skeleton, mesh, curve);
    measure_radii(out.skeleton, mesh);
    out.skeleton.quality.matched_nodes = embedding.matched_nodes;
    doubt_loops(out.skeleton, loops(curve));
    timings.sides += stage.lap();
    return out;
}

/// Fits the skeleton to `curve`. Where that fails or looks wrong, a limb has been lost or a junction shifted on the way
/// to the curve: finer proxies are tried, and `curve` is the one that serves best. \throws Error no_skeleton when none
/// does.
Fit fit_patiently(const BodyCurve& found, CurveSkeleton<double>& curve, const SkeletonTemplate& wanted,
                  const ExtractOptions& options, StageTimings& timings) {
    constexpr int attempts = 3; // each half as fine again as the last one
    constexpr int suspicious = 3;
    std::optional<Fit> best;
    std::optional<Error> failure;
    ProxyOptions finer = options.proxy;
    CurveSkeleton<double> next = curve;
    for (int attempt = 1;; ++attempt) {
        try {
            Fit fit = fit_skeleton(found.body.mesh, found.surface, next, wanted, options, timings);
            if (!best || fit.misplaced < best->misplaced) {
                best = std::move(fit);
                curve = next;
            }
        } catch (const Refusal&) {
            throw;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::no_skeleton) throw;
            if (!failure) failure = error;
        }
        if (attempt == attempts || (best && best->misplaced < suspicious)) break;
        finer.vertices += finer.vertices / 2;
        Stopwatch stage;
        next = extract_curve(found.body.mesh, found.surface, build_proxy(found.body.mesh, finer), options.curve);
        timings.curve += stage.lap();
    }
    if (!best) throw *failure;
    return *std::move(best);
}

} // namespace

template <typename Scalar>
CurveSkeleton<Scalar> find_curve_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    const BodyCurve found = find_body_curve(mesh, options);
    return BackToInput<Scalar>(found.similarity)
        .curve(settle_limb_ends(found.curve, found.body.mesh), found.body.source);
}

template <typename Scalar>
Extraction<Scalar> extract_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    Stopwatch total, stage;
    const SkeletonTemplate& wanted =
        options.skeleton_template.joints.empty() ? builtin_template("human21") : options.skeleton_template;
    validate_template(wanted);

    BodyCurve found = find_body_curve(mesh, options);
    Extraction<Scalar> out;
    out.timings.curve = stage.lap();

    CurveSkeleton<double> curve = std::move(found.curve);
    Fit fit = fit_patiently(found, curve, wanted, options, out.timings);
    if (found.body.dropped_pieces > 0)
        fit.skeleton.quality.warnings.push_back(std::to_string(found.body.dropped_pieces) +
                                                " pieces not connected to the body were left out");

    const BackToInput<Scalar> back(found.similarity);
    out.skeleton = back.skeleton(fit.skeleton);
    out.curve = back.curve(settle_limb_ends(curve, found.body.mesh), found.body.source);
    out.geodesic_diameter = found.similarity.scale * fit.geodesic_diameter;
    out.timings.total = total.lap();
    return out;
}

template CurveSkeleton<float> find_curve_skeleton(const TriangleMesh<float>&, const ExtractOptions&);
template CurveSkeleton<double> find_curve_skeleton(const TriangleMesh<double>&, const ExtractOptions&);
template Extraction<float> extract_skeleton(const TriangleMesh<float>&, const ExtractOptions&);
template Extraction<double> extract_skeleton(const TriangleMesh<double>&, const ExtractOptions&);

} // namespace skelgen
