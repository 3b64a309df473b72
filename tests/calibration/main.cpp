// Writes what the search finds in a mesh, all of it: of each candidate the evidence, the probability and the joints, as
// one line of JSON. `./dev calibrate` judges them by the true joints and fits the trust table.

#include <cstdlib>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/search/ladder.hpp>
#include <skelgen/surface/body.hpp>

using namespace skelgen;
using Json = nlohmann::ordered_json;

namespace {

Json numbers(const Vector3<double>& place) { return {place.x(), place.y(), place.z()}; }

Json described(const search::Found<double>& found, const SkeletonTemplate& wanted) {
    const search::Candidate<double>& candidate = found.candidate;
    const KinematicSkeleton<double> skeleton = surface::to_input(*found.body, candidate.skeleton);
    Json out;
    const search::Hypothesis& what = found.hypothesis;
    out["hypothesis"] = {std::string(search::to_string(what.surface)), std::string(search::to_string(what.opening)),
                         what.cuts, std::string(search::to_string(what.held)),
                         std::string(search::to_string(what.effort))};
    for (std::size_t w = 0; w < search::witness_count; ++w)
        out["evidence"][std::string(to_string(static_cast<search::Witness>(w)))] = candidate.evidence.values[w];
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

} // namespace

int main(int argc, char** argv) try {
    if (argc < 2 || argc > 5) {
        std::cerr << "usage: skelgen-candidates MESH [until_sure|exhaustive [ANIMATION TIME]]\n";
        return 2;
    }
    const bool is_exhaustive = argc > 2 && std::string(argv[2]) == "exhaustive";
    io::ReadMeshOptions options;
    if (argc == 5) {
        options.animation = argv[3];
        options.time = std::strtod(argv[4], nullptr);
    }
    const TriangleMesh<double> mesh = io::read_mesh<double>(argv[1], options);
    const SkeletonTemplate& wanted = builtin_template("human21");
    ExtractOptions search_options;
    search_options.budget = is_exhaustive ? 12 : search_options.budget;
    const search::Climb<double> climb =
        search::climb(mesh, wanted, search_options,
                      is_exhaustive ? search::Thoroughness::exhaustive : search::Thoroughness::until_sure);
    for (const search::Found<double>& found : climb.found) std::cout << described(found, wanted).dump() << '\n';
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
