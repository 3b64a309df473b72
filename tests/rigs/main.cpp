// skelgen-rigs FOLDER [--every N] [--like FOLDER [--like-every N]]: rigs of all bodies in a folder, and how well they
// bend; or how near their skeletons come to what they should be when they are held like the bodies of another folder.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <skelgen/applications/pose_transfer.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/read_mesh.hpp>

#include "quality.hpp"

namespace {

using namespace skelgen;
namespace fs = std::filesystem;

std::vector<fs::path> meshes_below(const fs::path& folder, std::size_t every) {
    std::vector<fs::path> all, out;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && io::mesh_format_of(entry.path())) all.push_back(entry.path());
    std::sort(all.begin(), all.end());
    for (std::size_t i = 0; i < all.size(); i += every) out.push_back(all[i]);
    return out;
}

/// Of one body.
struct Row {
    rigs::Quality quality;
    double seconds = 0; ///< from file to rig
    double arms = 0;    ///< degrees: the larger angle between level and an upper arm that is found in the un-posed body
    /// Mean distance between the body and the un-posed one, posed back by its rig as viewers do it, linearly; of the
    /// geodesic diameter.
    double rig_back = 0;
    /// Mean distance between the body and the un-posed one, its skeleton and skin found anew, posed back, of the
    /// geodesic diameter.
    double way_back = 0;
};

/// The larger angle of the upper arms from level, in degrees.
double slope_of_arms(const KinematicSkeleton<double>& skeleton) {
    double slope = 0;
    for (const std::string side : {"left_", "right_"}) {
        const auto place = [&](const char* name) {
            return skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, side + name))].position;
        };
        const Eigen::Vector3d arm = place("elbow") - place("shoulder");
        slope = std::max(slope, std::abs(std::asin(arm.normalized().y())) * 180 / std::numbers::pi);
    }
    return slope;
}

/// What each joint does when a body is brought to the T-pose, in the input's unit.
std::vector<applications::RigidMotion<double>> unposing(const KinematicSkeleton<double>& skeleton,
                                                        const SkeletonTemplate& human) {
    return applications::rest_motions<double>(applications::RestPose::t_pose, skeleton, human,
                                              applications::bone_orientations(skeleton, human),
                                              Eigen::Quaterniond::Identity());
}

std::vector<applications::RigidMotion<double>> inverse(std::vector<applications::RigidMotion<double>> motions) {
    for (auto& motion : motions) {
        motion.rotation = motion.rotation.conjugate();
        motion.translation = -(motion.rotation * motion.translation);
    }
    return motions;
}

/// Fills in what is seen of the un-posed body once its skeleton has been found again.
void look_at_unposed(Row& row, const TriangleMesh<double>& rest, const TriangleMesh<double>& mesh,
                     const Extraction<double>& was, const SkeletonTemplate& human) try {
    const Extraction<double> again = extract(rest);
    row.arms = slope_of_arms(again.skeleton);
    const auto back = applications::pose_like(rest, again.body, again.skeleton, was.skeleton, human);
    row.way_back = (back.mesh.vertices - mesh.vertices).rowwise().norm().mean() / was.geodesic_diameter;
} catch (const Error&) {
    row.arms = 90;
    row.way_back = 1;
}

Row measure_file(const fs::path& file) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto mesh = read_mesh<double>(file);
    const Extraction<double> found = extract(mesh);
    const KinematicSkeleton<double>& skeleton = found.skeleton;
    const SkeletonTemplate& human = builtin_template(skeleton.template_name);
    const auto rig = make_rig(mesh, found.body, skeleton, human, applications::RestPose::t_pose);
    Row row;
    row.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    row.quality = rigs::measure(rig);
    const auto motions = unposing(skeleton, human);
    const TriangleMesh<double> rest{applications::skinned(mesh.vertices, rig.skin, motions), mesh.faces};
    const auto back = applications::skinned_linearly(rest.vertices, rig.skin, inverse(motions));
    row.rig_back = (back - mesh.vertices).rowwise().norm().mean() / found.geodesic_diameter;
    look_at_unposed(row, rest, mesh, found, human);
    return row;
}

void print(const std::string& name, const Row& row) {
    const rigs::Quality& q = row.quality;
    std::printf("%-28s %7.3f %9.1e %7.2f%% %7d %8.2f %7.3f%% %7.1f%% %7.2f%% %8.4f %6.1f %8.4f\n", name.c_str(),
                row.seconds, q.worst_sum, 100 * q.two_limbs, q.islands, q.stretch, 100 * q.overstretched,
                100 * q.volume, 100 * q.gap, row.rig_back, row.arms, row.way_back);
    std::fflush(stdout);
}

/// Mean distance of the joints that are found in a posed body from where they went, of the geodesic diameter; none
/// where no skeleton is found.
std::optional<double> transfer_error(const fs::path& body, const fs::path& model) try {
    const auto mesh = read_mesh<double>(body);
    const Extraction<double> found = extract(mesh);
    const KinematicSkeleton<double>& own = found.skeleton;
    const auto other = extract_skeleton(read_mesh<double>(model)).skeleton;
    const auto posed = applications::pose_like(mesh, found.body, own, other, builtin_template(own.template_name));
    const auto again = extract_skeleton(posed.mesh);
    double sum = 0;
    for (std::size_t j = 0; j < own.joints.size(); ++j)
        sum += (again.skeleton.joints[j].position - posed.skeleton.joints[j].position).norm();
    return sum / static_cast<double>(own.joints.size()) / again.geodesic_diameter;
} catch (const Error&) {
    return std::nullopt;
}

void compare_poses(const std::vector<fs::path>& bodies, const std::vector<fs::path>& models) {
    constexpr double near = 0.03;
    int good = 0, all = 0;
    for (const fs::path& body : bodies)
        for (const fs::path& model : models) {
            const auto error = transfer_error(body, model);
            good += error && *error <= near ? 1 : 0;
            ++all;
            std::printf("%-28s like %-28s %s\n", body.stem().string().c_str(), model.stem().string().c_str(),
                        error ? std::to_string(*error).c_str() : "no skeleton");
            std::fflush(stdout);
        }
    std::printf("within %.2f: %d of %d\n", near, good, all);
}

void print_table(const std::vector<fs::path>& bodies) {
    std::printf("%-28s %7s %9s %8s %7s %8s %8s %8s %8s %8s %6s %8s\n", "body", "seconds", "sums", "2 limbs", "islands",
                "stretch", "above 3", "volume", "gaps", "by rig", "arms", "back");
    for (const fs::path& file : bodies) {
        try {
            print(file.stem().string(), measure_file(file));
        } catch (const Error& error) {
            std::printf("%-28s refused: %s\n", file.stem().string().c_str(), error.what());
        }
    }
}

} // namespace

int main(int argc, char** argv) {
    std::string folder, like;
    std::size_t every = 1, like_every = 1;
    CLI::App app("Measures rigs of bodies.", "skelgen-rigs");
    app.add_option("FOLDER", folder, "Folder of meshes")->required();
    app.add_option("--every", every, "Only every so many-th")->check(CLI::Range(1, 1000));
    app.add_option("--like", like, "Folder of the bodies whose poses they are to take");
    app.add_option("--like-every", like_every, "Only every so many-th of those")->check(CLI::Range(1, 1000));
    CLI11_PARSE(app, argc, argv);
    try {
        const auto bodies = meshes_below(folder, every);
        if (like.empty())
            print_table(bodies);
        else
            compare_poses(bodies, meshes_below(like, like_every));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "skelgen-rigs: error: " << error.what() << '\n';
        return 1;
    }
}
