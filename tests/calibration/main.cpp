// Writes what the search finds in a mesh, all of it: of each candidate the evidence, the probability and the joints, as
// one line of JSON. `./dev calibrate` judges them by the true joints and fits the trust table. With `known` instead:
// the proportions of a body in any pose, laid into the mesh with its joints where they are known to be.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/quadruped/impl/place_joints.hpp>
#include <skelgen/quadruped/limbs.hpp>
#include <skelgen/search/impl/agreement.hpp>
#include <skelgen/search/ladder.hpp>
#include <skelgen/search/laid_model.hpp>
#include <skelgen/search/posed_fit.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/prepare.hpp>

using namespace skelgen;
using Json = nlohmann::ordered_json;

namespace {

Json numbers(const Vector3<double>& place) { return {place.x(), place.y(), place.z()}; }

Json described(const search::Found<double>& found, const SkeletonTemplate& wanted) {
    const search::Candidate<double>& candidate = found.candidate;
    const KinematicSkeleton<double> skeleton = surface::to_input(*found.body, candidate.skeleton);
    Json out;
    const search::Hypothesis& what = found.hypothesis;
    out["hypothesis"] = {std::string(search::to_string(what.surface)), std::string(search::to_string(what.effort))};
    for (std::size_t w = 0; w < search::witness_count; ++w)
        out["evidence"][std::string(to_string(static_cast<search::Witness>(w)))] = candidate.evidence.values[w];
    for (std::size_t w = 0; w < symmetry::side_witness_count; ++w)
        out["sides"][std::string(to_string(static_cast<symmetry::SideWitness>(w)))] = candidate.sides.values[w];
    out["probability"] = candidate.probability;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Joint<double>& joint = skeleton.joints[j];
        if (!joint.is_present) continue;
        out["joints"][joint.name] = numbers(joint.position);
        out["doubt"][joint.name] = candidate.doubt[j];
    }
    out["template"] = wanted.name;
    return out;
}

/// Of each joint its share of its way, and the directions in which it may lie off that.
Json described_places(const Body<double>& body, const CurveSkeleton<double>& curve,
                      const quadruped::Limbs<double>& limbs, const SkeletonTemplate& wanted) {
    Json out;
    for (int j = 0; j < static_cast<int>(wanted.joints.size()); ++j) {
        const TemplateJoint& joint = wanted.joint(j);
        const auto& place = quadruped::place_of(joint.role, quadruped::detail::ordinal_of(wanted, j));
        const std::vector<int>& way = quadruped::detail::way_of(limbs, place.way, joint.side);
        if (way.empty()) continue;
        const quadruped::detail::WayLine<double> line(curve, way);
        const Vector3<double> from = body.similarity.to_input(line.place(place.share));
        const Vector3<double> zero = body.similarity.to_input(Vector3<double>::Zero());
        Json& described = out[joint.name];
        described["place"] = numbers(from);
        for (const auto& direction :
             quadruped::detail::directions_of(body, curve, limbs, line, place.share, sign_of(joint.side)).colwise())
            described["directions"].push_back(numbers(body.similarity.to_input(direction) - zero));
    }
    return out;
}

/// All ways to see an animal in the curve of what was found; the likeliest with what their joints' places go by.
void describe_animals(const search::Found<double>& found, const SkeletonTemplate& wanted) {
    std::size_t count = 0;
    const Body<double>& body = *found.body;
    const CurveSkeleton<double>& curve = found.curve->curve;
    for (const quadruped::Limbs<double>& limbs : quadruped::find_limbs(curve, 150)) {
        Json out;
        out["effort"] = std::string(search::to_string(found.hypothesis.effort));
        for (std::size_t w = 0; w < quadruped::witness_count; ++w)
            out["evidence"][std::string(to_string(static_cast<quadruped::Witness>(w)))] = limbs.evidence.values[w];
        out["probability"] = limbs.probability;
        out["size"] = body.similarity.scale * limbs.size;
        const auto put_end = [&](const char* name, const std::vector<int>& way, bool is_last) {
            if (way.empty()) return;
            const int node = is_last ? way.back() : way.front();
            out["ends"][name] = numbers(body.similarity.to_input(core::point(curve.nodes, node)));
        };
        const std::array feet{"left_fore_foot", "right_fore_foot", "left_hind_foot", "right_hind_foot"};
        for (std::size_t leg = 0; leg < feet.size(); ++leg) put_end(feet[leg], limbs.legs[leg], false);
        put_end("head", limbs.neck, true);
        put_end("tail", limbs.tail, true);
        constexpr std::size_t with_places = 5;
        if (count++ < with_places) out["joints"] = described_places(body, curve, limbs, wanted);
        std::cout << out.dump() << '\n';
    }
}

/// Where a head starts from whose rig says nothing of its top: that is the highest place of the surface above the neck.
Vector3<double> head_above(const TriangleMesh<double>& mesh, const Vector3<double>& crotch,
                           const Vector3<double>& neck) {
    constexpr double beside = 0.12; // of the extent: so far from the trunk's line there are hands and hats
    const Vector3<double> up = (neck - crotch).normalized();
    const double extent = (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
    double top = 0;
    for (const auto& vertex : mesh.vertices.rowwise()) {
        const Vector3<double> off = vertex.transpose() - neck;
        if (off.cross(up).norm() < beside * extent) top = std::max(top, off.dot(up));
    }
    return neck + search::detail::head_at * top * up;
}

/// `places`: of all joints of human21, perhaps but the head, where a fit starts from, and `known` of those that are
/// certain, in the mesh's coordinates.
void describe_proportions(const TriangleMesh<double>& mesh, const Json& places) {
    const SkeletonTemplate& wanted = builtin_template("human21");
    surface::BodyMaterial<double> material = surface::gather(mesh);
    const surface::Remedy remedy = material.remedies.front();
    const Outcome<Body<double>> body = surface::make_body_by(remedy, std::move(material));
    if (!body) return;
    const auto place = [&](const Json& of) {
        return body->similarity.to_canonical(Vector3<double>(of.at(0), of.at(1), of.at(2)));
    };
    const Json& starts = places.at("start");
    Points<double> start(static_cast<Eigen::Index>(wanted.joints.size()), 3);
    std::vector<search::KnownPlace> known;
    for (int j = 0; j < static_cast<int>(wanted.joints.size()); ++j) {
        const std::string& name = wanted.joint(j).name;
        const Vector3<double> from = name == "head" && !starts.contains(name)
                                         ? head_above(body->mesh, place(starts.at("crotch")), place(starts.at("neck")))
                                         : place(starts.at(name));
        start.row(j) = from.transpose();
        if (places.at("known").contains(name)) known.push_back({j, place(places.at("known").at(name))});
    }
    const auto fits = search::fit_posed(*body, wanted, {start}, known);
    if (!fits.empty()) std::cout << Json(fits.front().proportions).dump() << '\n';
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 2 || argc > 6) {
        std::cerr << "usage: skelgen-candidates MESH [until_sure|exhaustive [TEMPLATE [ANIMATION TIME]]]\n"
                     "       skelgen-candidates MESH known PLACES.json [ANIMATION TIME]\n";
        return 2;
    }
    const std::string what = argc > 2 ? argv[2] : "";
    const bool is_exhaustive = what == "exhaustive";
    io::ReadMeshOptions options;
    if (argc == 6) {
        options.animation = argv[4];
        options.time = std::strtod(argv[5], nullptr);
    }
    const TriangleMesh<double> mesh = io::read_mesh<double>(argv[1], options);
    if (what == "known") {
        describe_proportions(mesh, Json::parse(std::ifstream(argc > 3 ? argv[3] : "")));
        return 0;
    }
    const SkeletonTemplate& wanted = builtin_template(argc > 3 ? argv[3] : "human21");
    const search::Climb<double> climb = search::climb(
        mesh, wanted, {}, is_exhaustive ? search::Thoroughness::exhaustive : search::Thoroughness::until_sure);
    const double extent = climb.found.empty() ? 0 : search::extent_of(*climb.found.front().whole);
    std::size_t tries = 0;
    int of_this_try = 0;
    double seconds = 0; // until a candidate's try ended
    for (const search::Found<double>& found : climb.found) {
        for (; is_exhaustive && of_this_try == 0; ++tries) {
            of_this_try = climb.trail[tries].candidates;
            seconds += climb.trail[tries].seconds;
        }
        --of_this_try;
        if (wanted.plan == BodyKind::quadruped) {
            describe_animals(found, wanted);
        } else {
            Json line = described(found, wanted);
            line["try"] = tries;
            line["seconds"] = seconds;
            line["extent"] = extent;
            std::cout << line.dump() << '\n';
        }
    }
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
