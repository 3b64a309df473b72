#pragma once

#include <skelgen/search/ladder.hpp>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <skelgen/anatomy/complete.hpp>
#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/quadruped/limbs.hpp>
#include <skelgen/quadruped/place_joints.hpp>
#include <skelgen/search/impl/agreement.hpp>
#include <skelgen/search/impl/consensus.hpp>
#include <skelgen/search/trust.hpp>
#include <skelgen/surface/open_handles.hpp>
#include <skelgen/surface/pockets.hpp>

namespace skelgen::search {
namespace detail {

/// How far a body's vertices have been moved off the input's by smoothing: the root mean square, part of its size.
template <typename Scalar>
double smoothed_away(const Body<Scalar>& body, const TriangleMesh<Scalar>& mesh) {
    core::Accumulator sum = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < body.source.size(); ++v) {
        if (body.source[v] < 0) continue;
        const auto row = static_cast<Eigen::Index>(v);
        sum += (body.similarity.to_canonical(core::point(mesh.vertices, body.source[v])) -
                core::point(body.mesh.vertices, row))
                   .squaredNorm();
        ++count;
    }
    const double size = static_cast<double>(core::bounding_diagonal(body.mesh.vertices));
    return count > 0 && size > 0 ? std::sqrt(static_cast<double>(sum) / static_cast<double>(count)) / size : 0;
}

/// Do all of its pieces, or some of them, make the surface together?
inline bool is_envelope(surface::Remedy remedy) {
    return remedy == surface::Remedy::envelope || remedy == surface::Remedy::alike_pieces ||
           remedy == surface::Remedy::bridged;
}

/// So much noise, a centimetre on a person, may have moved joints.
inline constexpr double much_noise = 0.005;

/// A surface that a remedy has made of the mesh.
template <typename Scalar>
struct PreparedSurface {
    std::shared_ptr<const Body<Scalar>> whole;
    std::shared_ptr<const Body<Scalar>> opened; ///< pockets closed and handles opened; the same where it has none
    double noise = 0;
};

/// When a hypothesis is tried: those of lesser rungs promise more for their time.
struct Rung {
    int round = 0; ///< 0 where a body seems to be one piece, 1 for envelopes then, which take longer
    int step = 0;  ///< 0 for the draft of each surface, and a body at rest laid into it
    int surface = 0;

    friend auto operator<=>(const Rung&, const Rung&) = default;
};

/// A hypothesis that waits to be tried, with what is known of it from the one that led to it.
template <typename Scalar>
struct Lead {
    Hypothesis what;
    Rung rung;
    std::shared_ptr<const curve::CurveResult<Scalar>> curve = {}; ///< none: to be found
};

template <typename Scalar>
class Ladder {
public:
    Ladder(const TriangleMesh<Scalar>& mesh, const SkeletonTemplate& wanted, const ExtractOptions& options,
           Thoroughness thoroughness, std::vector<KnownPlace> known)
        : mesh_(mesh), wanted_(wanted), options_(options), thoroughness_(thoroughness), known_(std::move(known)),
          animal_(wanted.plan == BodyKind::quadruped ? &wanted
                  : options.or_quadruped             ? &builtin_template("quadruped")
                                                     : nullptr) {}

    Climb<Scalar> run() {
        core::Stopwatch stage;
        material_ = surface::gather(mesh_, options_.prepare);
        out_.timings.surface = stage.lap();
        if (material_.stood_on_plate) options_.refinement.limbs_may_be_cut = false; // it is what has cut the soles
        remedies_ = material_.remedies;
        const bool are_several = material_.bodies > 1 && options_.prepare.component == 0;
        if (are_several) { // unless they are parts of one
            out_.failure = surface::several_bodies(material_.bodies);
            remedies_ = {surface::Remedy::bridged};
        }
        vertices_ = surface::input_vertices(material_);
        for (std::size_t i = 0; i < remedies_.size(); ++i) {
            const bool is_later = is_envelope(remedies_[i]) && !is_envelope(remedies_.front());
            Hypothesis what{remedies_[i]};
            if (for_animal_alone()) what.effort = Effort::detailed;
            add({what, {is_later ? 1 : 0, 0, static_cast<int>(i)}});
        }
        int spent = 0;
        while (!is_sure() && !leads_.empty()) {
            const Lead<Scalar> lead = next();
            const int cost = cost_of(lead.what.effort);
            if (spent + cost > options_.budget) continue; // a cheaper one may still be within it
            if (options_.before_try) options_.before_try(spent, options_.budget);
            spent += cost;
            try_lead(lead);
        }
        if (thoroughness_ == Thoroughness::until_sure && !out_.found.empty()) {
            Found<Scalar> best = placed_by_all();
            best.candidate.probability = likeliest_yet();
            // A body can be laid into anything: where no curve shows one, or bodies are apart, one has to be likelier
            // than not, or else why there is none is the answer.
            constexpr double likelier_than_not = 0.5;
            const bool is_answer = best.candidate.probability > likelier_than_not ||
                                   (!are_several && (best.plan == BodyKind::quadruped || is_any_in_curve()));
            out_.found.clear();
            if (is_answer) out_.found.push_back(std::move(best));
        }
        return std::move(out_);
    }

private:
    /// Each try that is not sure leads to those on higher steps: what costs more comes later.
    static constexpr int for_rest_fit = 0, for_detailed = 1, for_more_detailed = 9, for_posed = 12;

    void add(Lead<Scalar> lead) {
        const auto place = std::upper_bound(leads_.begin(), leads_.end(), lead,
                                            [](const auto& a, const auto& b) { return a.rung < b.rung; });
        leads_.insert(place, std::move(lead));
    }

    Lead<Scalar> next() {
        Lead<Scalar> lead = std::move(leads_.front());
        leads_.erase(leads_.begin());
        return lead;
    }

    /// The likeliest skeleton yet, the first of equals.
    [[nodiscard]] auto likeliest() const {
        return std::max_element(out_.found.begin(), out_.found.end(), [](const auto& a, const auto& b) {
            return a.candidate.probability < b.candidate.probability;
        });
    }

    /// Its probability, beside the likeliest one of the other plan.
    [[nodiscard]] double likeliest_yet() const {
        if (out_.found.empty()) return 0;
        const Found<Scalar>& best = *likeliest();
        double other = best.plan == BodyKind::human ? animal_in_draft_ : 0;
        for (const Found<Scalar>& each : out_.found)
            if (each.plan != best.plan) other = std::max(other, each.candidate.probability);
        return probability_beside(best.candidate.probability, other);
    }

    /// Whether a template for a person was laid into a curve to find it.
    static bool is_in_curve(const Found<Scalar>& found) {
        return found.plan == BodyKind::human && found.candidate.evidence[Witness::fitted] == 0;
    }

    [[nodiscard]] bool is_any_in_curve() const {
        return std::any_of(out_.found.begin(), out_.found.end(), is_in_curve);
    }

    /// Whether bodies in any pose are laid into the surface that a remedy makes: into the first, and into each that
    /// pieces make together.
    [[nodiscard]] bool may_be_posed(surface::Remedy remedy) const {
        return remedy == remedies_.front() || is_envelope(remedy);
    }

    /// The candidate that says which joints there are. Of those that agree with the likeliest one it is the first that
    /// is nearly as likely and was found in a curve, for bodies that are laid in lack nothing; the likeliest itself
    /// where there is none.
    [[nodiscard]] std::size_t best_in_curve() const {
        constexpr double alike = 0.6, nearly_as_likely = 2; // in log odds
        const auto log_odds = [&](std::size_t i) { return core::log_odds(out_.found[i].candidate.probability); };
        const auto best = static_cast<std::size_t>(likeliest() - out_.found.begin());
        if (out_.found[best].plan != BodyKind::human) return best;
        for (std::size_t i = 0; i < out_.found.size(); ++i)
            if (is_in_curve(out_.found[i]) && log_odds(i) >= log_odds(best) - nearly_as_likely &&
                agreement(places_[i], places_[best], extent_) >= alike)
                return i;
        return best;
    }

    /// It with its joints where all candidates together expect these, each counted by its odds.
    [[nodiscard]] Found<Scalar> placed_by_all() const {
        constexpr double exactness_in_curves = 3.3; // times that of fits, on the bodies of FAUST: 0.005 beside 0.0166
        constexpr double surest = 0.9999;
        const std::size_t best = best_in_curve();
        Found<Scalar> out = out_.found[best];
        if (out.plan != BodyKind::human || out_.found.size() == 1) return out;
        std::vector<double> weights;
        for (const Found<Scalar>& each : out_.found) {
            const double probability = std::min(each.candidate.probability, surest);
            weights.push_back(probability / (1 - probability) * (is_in_curve(each) ? exactness_in_curves : 1));
        }
        Points<Scalar> places = expected_places(places_, weights, best, wanted_).template cast<Scalar>();
        for (Eigen::Index j = 0; j < places.rows(); ++j)
            places.row(j) = out.body->similarity.to_canonical(core::point(places, j)).transpose();
        KinematicSkeleton<Scalar>& skeleton = out.candidate.skeleton;
        skeleton = anatomy::with_joints_at(places, std::move(skeleton), *out.body, out.curve->curve, wanted_);
        return out;
    }

    [[nodiscard]] bool is_sure() const {
        return thoroughness_ == Thoroughness::until_sure && likeliest_yet() >= sure_enough;
    }

    /// The surface that a remedy makes, opened; a failure where nothing is enclosed.
    const Outcome<PreparedSurface<Scalar>>& surface_by(surface::Remedy remedy) {
        if (const auto known = surfaces_.find(remedy); known != surfaces_.end()) return known->second;
        const bool is_last = surfaces_.size() + 1 == remedies_.size();
        Outcome<Body<Scalar>> body =
            surface::make_body_by(remedy, is_last ? std::move(material_) : material_, options_.prepare);
        if (!body) return surfaces_.emplace(remedy, body.failure()).first->second;
        PreparedSurface<Scalar> out;
        out.whole = std::make_shared<const Body<Scalar>>(*std::move(body));
        out.opened = out.whole;
        if (auto closed = surface::close_pockets(*out.opened))
            out.opened = std::make_shared<const Body<Scalar>>(*std::move(closed));
        if (auto opened = surface::open_handles(*out.opened))
            out.opened = std::make_shared<const Body<Scalar>>(*std::move(opened));
        out.noise = smoothed_away(*out.whole, mesh_);
        return surfaces_.emplace(remedy, std::move(out)).first->second;
    }

    /// The one place where a curve is looked for.
    std::shared_ptr<const curve::CurveResult<Scalar>> curve_of(const Lead<Scalar>& lead, const Body<Scalar>& body) {
        if (lead.curve) return lead.curve;
        return std::make_shared<const curve::CurveResult<Scalar>>(
            find_curve(body, curve_options(lead.what.effort, options_.curve)));
    }

    void try_lead(const Lead<Scalar>& lead) {
        core::Stopwatch whole, stage;
        Tried entry{lead.what};
        const Outcome<PreparedSurface<Scalar>>& surface = surface_by(lead.what.surface);
        out_.timings.surface += stage.lap();
        if (!surface) return finish(entry, surface.failure(), whole.lap());
        const auto curve = curve_of(lead, *surface->opened);
        out_.timings.curve += stage.lap();

        if (lead.what.effort == Effort::rest_fit)
            try_at_rest(lead, *surface, curve, entry);
        else if (lead.what.effort == Effort::posed_fit)
            try_posed(lead, *surface, curve, entry);
        else if (lead.what.effort == Effort::draft)
            try_templates(lead, *surface, curve, entry);
        if (animal_ && needs_curve(lead.what.effort)) try_quadruped(lead, *surface, curve, entry);
        if (!is_sure()) follow(lead, curve);
        finish(entry, {}, whole.lap());
    }

    /// Whether something is laid into a curve, not into the surface.
    [[nodiscard]] static bool needs_curve(Effort effort) {
        return effort != Effort::rest_fit && effort != Effort::posed_fit;
    }

    /// Whether an animal is looked for, and no person.
    [[nodiscard]] bool for_animal_alone() const { return wanted_.plan == BodyKind::quadruped; }

    void finish(Tried entry, const Failure& failure, double milliseconds) {
        if (entry.candidates > 0) entry.refusal = Refusal::none;
        if (failure.reason != Refusal::none) {
            entry.refusal = failure.reason;
            if (out_.failure.reason == Refusal::none) out_.failure = failure;
        }
        entry.seconds = milliseconds / 1000;
        out_.trail.push_back(entry);
    }

    /// The template in the curve and, where it does not fit, ones that lack a limb. Where it fits with more distortion
    /// than whole bodies have, the stump of a leg may stand for it, or a limb may be shorter: ones that lack a leg, a
    /// forearm or a calf. Not where the curve has loops: legs that touch may pass for one.
    void try_templates(const Lead<Scalar>& lead, const PreparedSurface<Scalar>& surface,
                       const std::shared_ptr<const curve::CurveResult<Scalar>>& curve, Tried& entry) {
        constexpr std::size_t most_partial = 4;
        constexpr double usual = 0.006; // distortion per pair of whole bodies
        core::Stopwatch stage;
        if (curve->is_point) return refuse(entry, too_compact());
        const auto whole = embedding::embed(curve->curve, wanted_, options_.matching);
        out_.timings.embed += stage.lap();
        if (whole)
            try_laid(lead, surface, curve, {wanted_, *whole}, entry);
        else
            refuse(entry, whole.failure());
        const bool is_usual = whole && (distortion_per_pair(*whole) < usual || core::cycle_count(curve->curve) > 0);
        if (is_sure() || is_usual) return;
        stage.lap();
        const auto partial = embedding::without_a_limb(curve->curve, wanted_, most_partial, options_.matching);
        out_.timings.embed += stage.lap();
        for (const embedding::LaidTemplate& laid : partial)
            if (!whole || has_head_and_arms(laid.skeleton_template)) try_laid(lead, surface, curve, laid, entry);
    }

    /// Whether a template has a head and upper arms, whatever else it lacks.
    static bool has_head_and_arms(const SkeletonTemplate& laid) {
        return std::none_of(laid.joints.begin(), laid.joints.end(), [](const TemplateJoint& joint) {
            return joint.is_absent && (joint.role == JointRole::head || joint.role == JointRole::elbow);
        });
    }

    void try_at_rest(const Lead<Scalar>& lead, const PreparedSurface<Scalar>& surface,
                     const std::shared_ptr<const curve::CurveResult<Scalar>>& curve, Tried& entry) {
        core::Stopwatch stage;
        std::vector<KnownPlace> known = known_;
        for (auto& [joint, place] : known)
            place = surface.opened->similarity.to_canonical(place.template cast<Scalar>()).template cast<double>();
        const auto fit = fit_at_rest(*surface.opened, wanted_, known);
        out_.timings.refine += stage.lap();
        if (!fit) {
            refuse(entry, {Refusal::no_mirror, "no body at rest: the surface mirrors itself in no plane"});
            return;
        }
        try_placed(lead, surface, curve, entry, options_,
                   [&](const ExtractOptions& options) { return place_joints(*surface.opened, *fit, options); });
    }

    /// From the likeliest skeletons yet, and from bodies that stand along each axis of the surface.
    void try_posed(const Lead<Scalar>& lead, const PreparedSurface<Scalar>& surface,
                   const std::shared_ptr<const curve::CurveResult<Scalar>>& curve, Tried& entry) {
        constexpr std::size_t most_skeletons = 16;
        core::Stopwatch stage;
        std::vector<std::pair<double, std::size_t>> whole;
        for (std::size_t i = 0; i < out_.found.size(); ++i)
            if (places_[i].rows() > 0 && places_[i].allFinite())
                whole.emplace_back(out_.found[i].candidate.probability, i);
        std::stable_sort(whole.begin(), whole.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        if (whole.size() > most_skeletons) whole.resize(most_skeletons);
        std::vector<Points<double>> starts;
        for (const auto& [probability, i] : whole) {
            Points<double>& start = starts.emplace_back(places_[i]);
            for (Eigen::Index j = 0; j < start.rows(); ++j) {
                const Vector3<Scalar> place = core::point(start, j).template cast<Scalar>();
                start.row(j) = surface.opened->similarity.to_canonical(place).transpose().template cast<double>();
            }
        }
        for (Points<double>& start : standing_starts(*surface.opened, wanted_)) starts.push_back(std::move(start));
        const std::vector<PosedFit> fits = fit_posed(*surface.opened, wanted_, starts);
        const Scalar diameter = core::geodesic_diameter(surface.opened->graph);
        out_.timings.refine += stage.lap();
        for (const PosedFit& fit : fits)
            try_placed(lead, surface, curve, entry, options_,
                       [&](const ExtractOptions&) { return place_joints(*surface.opened, fit, diameter); });
    }

    void try_quadruped(const Lead<Scalar>& lead, const PreparedSurface<Scalar>& surface,
                       const std::shared_ptr<const curve::CurveResult<Scalar>>& curve, Tried& entry) {
        core::Stopwatch stage;
        const auto limbs = quadruped::find_limbs(curve->curve, 1);
        out_.timings.embed += stage.lap();
        if (lead.what.effort == Effort::draft) { // lacks tails, horns, trunks: what it shows asks for a closer look
            if (!limbs.empty()) animal_in_draft_ = std::max(animal_in_draft_, limbs.front().probability);
            return;
        }
        animal_in_draft_ = 0;
        if (limbs.empty()) {
            refuse(entry, {Refusal::too_few_ends, "no four-legged animal: its curve skeleton has no ends for four legs "
                                                  "and a head, in one piece; check that these stand free"});
            return;
        }
        Candidate<Scalar> candidate;
        candidate.skeleton = quadruped::place_joints(*surface.opened, curve->curve, limbs.front(), *animal_);
        candidate.doubt.assign(candidate.skeleton.joints.size(), 0);
        candidate.geodesic_diameter = core::geodesic_diameter(surface.opened->graph);
        candidate.probability = limbs.front().probability;
        keep(lead, surface, curve, std::move(candidate), entry, BodyKind::quadruped);
    }

    void try_laid(const Lead<Scalar>& lead, const PreparedSurface<Scalar>& surface,
                  const std::shared_ptr<const curve::CurveResult<Scalar>>& curve, const embedding::LaidTemplate& laid,
                  Tried& entry) {
        const auto ends =
            refinement::find_end_points(*surface.opened, curve->curve, laid.embedding, laid.skeleton_template);
        const auto placed = [&](const ExtractOptions& options) {
            return place_joints(*surface.opened, *curve, laid, ends, options);
        };
        const double likeliest = try_placed(lead, surface, curve, entry, options_, placed);
        const bool is_cut = last_cut_limbs_ > 0;
        if (!is_cut || (likeliest >= sure_enough && thoroughness_ == Thoroughness::until_sure)) return;
        ExtractOptions as_whole = options_; // flat soles may pass for cuts
        as_whole.refinement.limbs_may_be_cut = false;
        try_placed(lead, surface, curve, entry, as_whole, placed);
    }

    /// The skeleton of placed joints. \returns its probability.
    template <typename Place>
    double try_placed(const Lead<Scalar>& lead, const PreparedSurface<Scalar>& surface,
                      const std::shared_ptr<const curve::CurveResult<Scalar>>& curve, Tried& entry,
                      const ExtractOptions& options, Place place) {
        core::Stopwatch stage;
        PlacedJoints<Scalar> placed = place(options);
        placed.vertices = &vertices_;
        out_.timings.refine += stage.lap();
        Outcome<Candidate<Scalar>> candidate = skeleton_of(*surface.opened, *curve, placed);
        last_cut_limbs_ = candidate ? candidate->evidence[Witness::cut_limbs] : 0;
        if (candidate && lead.what.surface == surface::Remedy::alike_pieces && lacks_part(candidate->evidence))
            return 0; // what it lacks may be what was left out
        if (candidate) {
            candidate->evidence[Witness::envelope] = is_envelope(lead.what.surface) ? 1 : 0;
            return keep(lead, surface, curve, *std::move(candidate), entry);
        }
        refuse(entry, candidate.failure());
        return 0;
    }

    /// Keeps a candidate, and says of all people how far the others agree with each. \returns its probability.
    double keep(const Lead<Scalar>& lead, const PreparedSurface<Scalar>& surface,
                const std::shared_ptr<const curve::CurveResult<Scalar>>& curve, Candidate<Scalar> candidate,
                Tried& entry, BodyKind plan = BodyKind::human) {
        out_.timings = out_.timings + candidate.timings;
        ++entry.candidates;
        if (out_.found.empty()) extent_ = extent_of(*surface.whole);
        places_.push_back(plan == BodyKind::human ? joints_in_input(candidate.skeleton, *surface.opened)
                                                  : Points<double>());
        out_.found.push_back(
            {std::move(candidate), surface.opened, surface.whole, curve, lead.what, surface.noise, plan});
        if (plan == BodyKind::human) hear_the_others();
        const Candidate<Scalar>& kept = out_.found.back().candidate;
        if (kept.probability > entry.probability) {
            entry.probability = kept.probability;
            entry.lacks_limb = lacks_part(kept.evidence);
        }
        return kept.probability;
    }

    /// Says of each candidate how far the others agree with it, the last of which is new.
    void hear_the_others() {
        const std::size_t last = places_.size() - 1;
        agreed_.resize(places_.size(), 0);
        double others = 0;
        for (std::size_t i = 0; i < last; ++i) {
            if (places_[i].rows() == 0) continue;
            const double both = agreement(places_[i], places_[last], extent_);
            agreed_[i] += both;
            agreed_[last] += both;
            others += 1;
        }
        const double heard = others / (others + dissenters);
        double lacking = 0, in_curves = 0;
        for (const Found<Scalar>& each : out_.found) {
            if (!is_in_curve(each)) continue;
            lacking += lacking_parts(each.candidate.evidence);
            in_curves += 1;
        }
        for (std::size_t i = 0; i <= last; ++i) {
            if (places_[i].rows() == 0) continue;
            Candidate<Scalar>& candidate = out_.found[i].candidate;
            const double own = lacking_parts(candidate.evidence);
            candidate.evidence[Witness::others_lack] = in_curves > 0 ? std::max(0.0, lacking / in_curves - own) : 0;
            candidate.evidence[Witness::agreed] = agreed_[i] / (others + dissenters);
            candidate.evidence[Witness::heard] = heard;
            candidate.probability = probability_right(candidate.evidence);
        }
    }

    /// Joints in the input's coordinates, not finite where they are absent.
    static Points<double> joints_in_input(const KinematicSkeleton<Scalar>& skeleton, const Body<Scalar>& body) {
        Points<double> out(static_cast<Eigen::Index>(skeleton.joints.size()), 3);
        for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
            auto row = out.row(static_cast<Eigen::Index>(j));
            if (skeleton.joints[j].is_present)
                row = body.similarity.to_input(skeleton.joints[j].position).transpose().template cast<double>();
            else
                row.setConstant(std::numeric_limits<double>::quiet_NaN());
        }
        return out;
    }

    static double lacking_parts(const Evidence& evidence) {
        return evidence[Witness::lacks_head] + evidence[Witness::lacks_limbs] + evidence[Witness::cut_limbs];
    }
    static bool lacks_part(const Evidence& evidence) { return lacking_parts(evidence) > 0; }

    void refuse(Tried& entry, const Failure& failure) {
        if (entry.refusal == Refusal::none) entry.refusal = failure.reason;
        if (out_.failure.reason == Refusal::none) out_.failure = failure;
    }

    /// What else a try leads to that is not sure.
    void follow(const Lead<Scalar>& lead, const std::shared_ptr<const curve::CurveResult<Scalar>>& curve) {
        if (!needs_curve(lead.what.effort) || curve->is_point) return;
        const auto lead_to = [&](Effort effort, int step, bool is_in_curve) {
            Lead<Scalar> next{lead.what, {lead.rung.round, step, lead.rung.surface}};
            next.what.effort = effort;
            if (is_in_curve) next.curve = curve;
            add(std::move(next));
        };
        if (lead.what.effort == Effort::draft) {
            if (animal_) lead_to(Effort::detailed, for_detailed, false);
            lead_to(Effort::rest_fit, for_rest_fit, true);
            if (!for_animal_alone() && known_.empty() && may_be_posed(lead.what.surface)) // hints have their own bodies
                lead_to(Effort::posed_fit, for_posed, true);
        }
        if (lead.what.effort == Effort::detailed) lead_to(Effort::more_detailed, for_more_detailed, false);
    }

    const TriangleMesh<Scalar>& mesh_;
    const SkeletonTemplate& wanted_;
    ExtractOptions options_;
    Thoroughness thoroughness_;
    std::vector<KnownPlace> known_;  ///< in the mesh's coordinates
    const SkeletonTemplate* animal_; ///< looked for, too, or alone; none: people are looked for alone
    double animal_in_draft_ = 0;     ///< probability of one there, until a finer curve tells
    surface::BodyMaterial<Scalar> material_;
    std::vector<surface::Remedy> remedies_; ///< of the material, which the last of them takes
    Points<Scalar> vertices_;               ///< of the input
    std::map<surface::Remedy, Outcome<PreparedSurface<Scalar>>> surfaces_;
    std::vector<Lead<Scalar>> leads_;    ///< by rung
    double last_cut_limbs_ = 0;          ///< of the candidate tried last
    double extent_ = 1;                  ///< of the first surface that shows a skeleton
    std::vector<Points<double>> places_; ///< per candidate its joints in the input's coordinates; none of an animal
    std::vector<double> agreed_;         ///< per candidate the sum of its agreement with the others
    Climb<Scalar> out_;
};

inline std::string noise_smoothed(double noise) {
    const auto tenths = static_cast<int>(std::lround(1000 * noise)); // of a per cent
    return "noise smoothed away: " + std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " % of the size";
}

} // namespace detail

template <typename Scalar>
KinematicSkeleton<Scalar> skeleton_in_input(const Found<Scalar>& found) {
    return surface::to_input(
        *found.body, with_confidence(found.candidate.skeleton, found.candidate.probability, found.candidate.doubt));
}

template <typename Scalar>
std::vector<std::string> warnings_of(const Found<Scalar>& found, const SkeletonTemplate& wanted) {
    const Evidence& evidence = found.candidate.evidence;
    const KinematicSkeleton<Scalar>& skeleton = found.candidate.skeleton;
    std::vector<std::string> out;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
        if (skeleton.joints[j].is_present && found.candidate.doubt[j] > anatomy::misplaced_from)
            out.push_back("joint " + skeleton.joints[j].name + " may be misplaced: its bones have unlikely lengths");
    if (evidence[Witness::lacks_head] > 0) out.push_back("the body seems to lack its head");
    if (evidence[Witness::lacks_limbs] > 0) {
        for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
            if (!skeleton.joints[j].is_present && ends_limb(wanted.joints[j].role))
                out.push_back(std::string("the body seems to lack ") + (part_of(wanted.joints[j].role) == BodyPart::arm
                                                                            ? "an arm or part of it"
                                                                            : "a leg or part of it"));
    }
    const bool is_fitted = evidence[Witness::fitted] > 0;
    if (is_fitted)
        out.push_back("its curve skeleton does not show it all: a model of a body was laid into the surface");
    const int contacts = is_fitted ? 0 : core::cycle_count(found.curve->curve);
    if (contacts > 0)
        out.push_back("the body touches itself in " + std::to_string(contacts) +
                      (contacts == 1 ? " place" : " places") + ": limbs may be mistaken");
    out.insert(out.end(), found.body->repairs.begin(), found.body->repairs.end());
    if (found.body->dropped_pieces > 0)
        out.push_back(std::to_string(found.body->dropped_pieces) + " pieces not connected to the body were left out");
    if (found.noise > detail::much_noise) out.push_back(detail::noise_smoothed(found.noise));
    if (!found.curve->converged) out.push_back("the curve skeleton's contraction did not converge");
    return out;
}

template <typename Scalar>
Climb<Scalar> climb(const TriangleMesh<Scalar>& mesh, const SkeletonTemplate& wanted, const ExtractOptions& options,
                    Thoroughness thoroughness, std::vector<KnownPlace> known) {
    return detail::Ladder<Scalar>(mesh, wanted, options, thoroughness, std::move(known)).run();
}

} // namespace skelgen::search
