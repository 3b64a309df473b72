// skelgen-noise FOLDER... [--noise PART] [--jobs N]: finds every skeleton twice, on the mesh as it is and with its
// vertices displaced by far less than any scanner sees, and says where the two answers differ and are not in doubt.
// Exit status 0: nowhere; 1: somewhere.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "parallel.hpp"

namespace {

namespace fs = std::filesystem;
using namespace skelgen;

constexpr double same = 1e-3;    ///< of the geodesic diameter: joints nearer to each other are at one place
constexpr double in_doubt = 0.5; ///< confidence below which an answer may be another one

struct Options {
    std::vector<std::string> folders;
    double noise = 1e-7; ///< of the bounding box's diagonal
    unsigned seeds = 1;  ///< how many noises each mesh is given, one after another
    unsigned jobs = 1;
};

/// How two answers to one question compare.
struct Comparison {
    bool answered = false, refused = false; ///< both of them
    double distance = 0;   ///< of the joint that moved farthest, over the geodesic diameter; 1: one answer is missing
    double confidence = 0; ///< the largest one in what differs, of the answer that is less sure of it
    std::string what;      ///< differs most
    [[nodiscard]] bool is_same() const { return distance <= same; }
    [[nodiscard]] bool is_flip() const { return !is_same() && confidence >= in_doubt; }
};

std::optional<Extraction<double>> extract(const TriangleMesh<double>& mesh) {
    try {
        return extract_skeleton(mesh);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_skeleton && error.code() != ErrorCode::bad_input) throw;
        return std::nullopt;
    }
}

TriangleMesh<double> with_noise(TriangleMesh<double> mesh, double part, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, part * core::bounding_diagonal(mesh.vertices));
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        for (int k = 0; k < 3; ++k) mesh.vertices(v, k) += normal(random);
    return mesh;
}

/// An answer is as sure of a joint as it is of the sides and of the joint itself.
double certainty(const KinematicSkeleton<double>& skeleton, const Joint<double>& joint) {
    return std::min(skeleton.quality.sides_confidence, joint.confidence);
}

Comparison compare(const std::optional<Extraction<double>>& a, const std::optional<Extraction<double>>& b) {
    Comparison out;
    out.refused = !a && !b;
    out.answered = a && b;
    if (!out.answered && !out.refused) {
        out.distance = 1;
        out.confidence = (a ? a : b)->skeleton.quality.sides_confidence;
        out.what = "refused once";
    }
    if (!out.answered) return out;
    for (std::size_t j = 0; j < a->skeleton.joints.size(); ++j) {
        const Joint<double>&p = a->skeleton.joints[j], &q = b->skeleton.joints[j];
        if (!p.is_present && !q.is_present) continue;
        const bool in_both = p.is_present && q.is_present;
        const double distance = in_both ? (p.position - q.position).norm() / a->geodesic_diameter : 1;
        if (distance > same)
            out.confidence = std::max(out.confidence, std::min(certainty(a->skeleton, p), certainty(b->skeleton, q)));
        if (distance <= out.distance) continue;
        out.distance = distance;
        out.what = p.name;
    }
    return out;
}

/// Of two comparisons the one that differs more, one that is not in doubt before others.
Comparison worse(const Comparison& a, const Comparison& b) {
    return std::pair(b.is_flip(), b.distance) < std::pair(a.is_flip(), a.distance) ? a : b;
}

std::vector<fs::path> meshes_below(const std::vector<std::string>& folders) {
    std::vector<fs::path> files;
    for (const std::string& folder : folders)
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file() && io::mesh_format_of(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

int run(const Options& options) {
    const std::vector<fs::path> files = meshes_below(options.folders);
    std::vector<Comparison> found(files.size());
    test::for_each_index(files.size(), options.jobs, [&](std::size_t i) {
        const TriangleMesh<double> mesh = read_mesh<double>(files[i]);
        const auto clean = extract(mesh);
        for (unsigned seed = 1; seed <= options.seeds; ++seed)
            found[i] = worse(found[i], compare(clean, extract(with_noise(mesh, options.noise, seed))));
    });
    std::size_t alike = 0, flips = 0, refused = 0;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const Comparison& each = found[i];
        refused += each.refused;
        alike += each.is_same();
        flips += each.is_flip();
        if (!each.is_same())
            std::printf("%s: %s by %.4f, confidence %.2f%s\n", files[i].c_str(), each.what.c_str(), each.distance,
                        each.confidence, each.is_flip() ? ": NOT IN DOUBT" : "");
    }
    std::printf("%zu meshes: %zu with the same answer (%zu of them refused), %zu with another one in doubt, %zu with "
                "another one that is not in doubt\n",
                files.size(), alike, refused, files.size() - alike - flips, flips);
    return flips == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Finds skeletons again after noise that nobody sees.", "skelgen-noise");
    app.add_option("FOLDER", options.folders, "Folders of meshes")->required();
    app.add_option("--noise", options.noise, "Standard deviation in each direction, of the bounding box's diagonal")
        ->capture_default_str();
    app.add_option("--seeds", options.seeds, "Noises for each mesh; the answer that differs most counts")
        ->check(CLI::Range(1U, 1000U))
        ->capture_default_str();
    app.add_option("--jobs", options.jobs, "Meshes at once")->check(CLI::Range(1U, 256U));
    CLI11_PARSE(app, argc, argv);
    try {
        return run(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "skelgen-noise: error: %s\n", error.what());
        return 1;
    }
}
