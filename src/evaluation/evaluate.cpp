#include <skelgen/evaluation/evaluate.hpp>

#include <algorithm>

#include <skelgen/core/error.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/read_mesh.hpp>

namespace skelgen::evaluation {
namespace {

namespace fs = std::filesystem;

/// Does `work`; an error of the input says which file it is about.
template <typename Work>
auto naming(const fs::path& file, const Work& work) {
    try {
        return work();
    } catch (const Error& error) {
        throw Error(error.code(), file.string() + ": " + error.what());
    }
}

/// The entries of a folder that `accept` wants, ordered by name.
template <typename Accept>
std::vector<fs::path> entries(const fs::path& folder, const Accept& accept) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().filename().native().front() != '.' && accept(*entry)) found.push_back(entry->path());
    if (error) throw Error(ErrorCode::bad_input, folder.string() + ": cannot be read: " + error.message());
    std::sort(found.begin(), found.end(), [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); });
    return found;
}

std::vector<fs::path> json_files(const fs::path& folder) {
    return entries(folder, [](const fs::directory_entry& entry) { return entry.path().extension() == ".json"; });
}

std::vector<fs::path> folders(const fs::path& folder) {
    return entries(folder, [](const fs::directory_entry& entry) { return entry.is_directory(); });
}

fs::path find_mesh(const fs::path& folder, const std::string& name) {
    for (const std::string_view extension : io::mesh_extensions()) {
        for (const char* const compressed : {"", ".gz"}) {
            fs::path file = folder / (name + std::string(extension) + compressed);
            if (fs::exists(file)) return file;
        }
    }
    throw Error(ErrorCode::bad_input, (folder / name).string() + ": no such mesh (" + io::mesh_extensions_text() + ")");
}

struct SetFolders {
    fs::path truth, prediction;
    std::optional<fs::path> meshes;

    [[nodiscard]] SetFolders in(const fs::path& set) const {
        return {truth / set, prediction / set, meshes ? std::optional(*meshes / set) : std::nullopt};
    }
};

MeshScore score_of_no_body(const fs::path& prediction) {
    MeshScore score;
    score.not_a_body = true;
    score.refused = !fs::exists(prediction);
    return score;
}

SetScore evaluate_set(const std::string& name, const SetFolders& set) {
    SetScore score{name, {}};
    for (const fs::path& truth : json_files(set.truth)) {
        const std::string mesh = truth.stem().string();
        std::optional<fs::path> mesh_file;
        if (set.meshes) mesh_file = find_mesh(*set.meshes, mesh);
        score.meshes.push_back(evaluate_file(truth, set.prediction / truth.filename(), mesh_file));
    }
    return score;
}

std::string folder_name(const fs::path& folder) {
    const fs::path name = fs::weakly_canonical(folder).filename();
    return name.empty() ? "all" : name.string();
}

} // namespace

MeshScore evaluate_file(const fs::path& truth, const fs::path& prediction, const std::optional<fs::path>& mesh) {
    const JointPositions joints = read_joint_positions(prediction);
    MeshScore score = naming(truth, [&] {
        const io::GroundTruth known = io::read_ground_truth(truth);
        return known.not_a_body ? score_of_no_body(prediction) : score_joints(known, joints);
    });
    score.name = truth.stem().string();
    score.confidences = read_joint_confidences(prediction);
    if (mesh && score.complete)
        score.outside = naming(*mesh, [&] { return joints_outside(io::read_mesh<double>(*mesh), joints, score.plan); });
    return score;
}

std::vector<SetScore> evaluate_folders(const fs::path& truth, const fs::path& prediction,
                                       const std::optional<fs::path>& meshes) {
    const SetFolders all{truth, prediction, meshes};
    std::vector<SetScore> scores;
    for (const fs::path& set : folders(truth))
        scores.push_back(evaluate_set(set.filename().string(), all.in(set.filename())));
    if (!scores.empty()) return scores;
    if (json_files(truth).empty())
        throw Error(ErrorCode::bad_input, truth.string() + ": holds no truth (<set>/<name>.json or <name>.json)");
    return {evaluate_set(folder_name(truth), all)};
}

} // namespace skelgen::evaluation
