#include "registered_set.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>

namespace skelgen::repeatability {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sorted_entries(const fs::path& folder) {
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
    std::sort(entries.begin(), entries.end());
    return entries;
}

bool have_equal_vertices(const std::vector<RegisteredBody>& bodies) {
    return std::all_of(bodies.begin(), bodies.end(), [&](const RegisteredBody& body) {
        return body.mesh.vertices.rows() == bodies.front().mesh.vertices.rows();
    });
}

} // namespace

test::Motion motion_of(unsigned seed) { return {test::random_rotation(seed), 1, Vector3<double>(1, 2, 3)}; }

RegisteredBody body_of(std::string name, const TriangleMesh<double>& mesh, unsigned seed) {
    RegisteredBody out;
    out.name = std::move(name);
    out.mesh = test::moved(mesh, motion_of(seed));
    const Extraction<double> found = extract(out.mesh);
    out.skeleton = found.skeleton;
    out.geodesic_diameter = found.geodesic_diameter;
    const applications::Segmentation bones = applications::segment(found.body, out.skeleton);
    out.measures = applications::measure(found.body, out.skeleton, bones);
    out.bones = applications::to_input(bones, found.body, out.mesh);
    out.body = applications::to_input(applications::segment(found.body, out.skeleton, applications::PartSet::body),
                                      found.body, out.mesh);
    out.comparable = applications::comparable(found.body, out.skeleton);
    out.stands_for = applications::standing_for(found.body, out.mesh.vertices);
    out.surface = found.body;
    return out;
}

std::vector<RegisteredSet> load_sets(const fs::path& meshes, std::size_t every) {
    std::vector<RegisteredSet> sets;
    for (const fs::path& folder : sorted_entries(meshes)) {
        if (!fs::is_directory(folder)) continue;
        std::vector<fs::path> files;
        for (const fs::path& file : sorted_entries(folder)) files.push_back(file);
        RegisteredSet set{folder.filename().string(), {}, {}};
        for (std::size_t i = 0; i < files.size(); i += every) {
            try {
                set.bodies.push_back(
                    body_of(files[i].stem().string(), read_mesh<double>(files[i]), static_cast<unsigned>(i)));
            } catch (const Error& error) {
                set.failures.push_back(files[i].filename().string() + ": " + error.what());
            }
        }
        if (set.bodies.size() > 1 && have_equal_vertices(set.bodies)) sets.push_back(std::move(set));
    }
    return sets;
}

} // namespace skelgen::repeatability
