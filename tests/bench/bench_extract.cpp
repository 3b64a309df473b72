// The time and memory that an extraction takes, stage by stage, beside CGAL's curve skeleton of the same mesh in the
// same process: on bodies of research sets, and on ever finer ones of our own. Ours finds named joints where CGAL's
// ends with the curve. Prints the table of docs/results.md.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/write_mesh.hpp>
#include <skelgen/synth/body.hpp>

#include "cgal_skeleton.hpp"
#include "program.hpp"

namespace {

using namespace skelgen;
namespace fs = std::filesystem;

constexpr std::size_t meshes_per_set = 10;
constexpr Eigen::Index most_for_cgal = 120000; // faces: it takes minutes from there on

/// CPU milliseconds of this process.
double cpu_ms() {
    std::timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double time_of(const std::function<void()>& work) {
    const double start = cpu_ms();
    work();
    return cpu_ms() - start;
}

/// kB of memory that this process has at once (VmRSS), or has had at most since `forget_peak` (VmHWM); 0 where the
/// system does not tell.
double memory_kb(const std::string& field) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (word == field + ":") {
            double value = 0;
            status >> value;
            return value;
        }
    return 0;
}

void forget_peak() {
#ifdef __GLIBC__
    malloc_trim(0); // what earlier work has left
#endif
    std::ofstream("/proc/self/clear_refs") << "5\n";
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// As `skelgen extract` looks for a skeleton: the curve, of which CGAL's is the measure, is a means.
ExtractOptions joints_alone() {
    ExtractOptions options;
    options.with_curve = false;
    return options;
}

/// What an extraction takes at once beside the mesh.
double peak_bytes(const TriangleMesh<double>& mesh) {
    forget_peak();
    const double before = memory_kb("VmRSS");
    [[maybe_unused]] const auto kept = extract_skeleton(mesh, joints_alone());
    return 1024 * (memory_kb("VmHWM") - before);
}

/// What was measured of one mesh, CPU milliseconds.
struct Measured {
    double faces = 0, read = 0, whole = 0, cgal = 0; ///< `cgal`: 0 where it does not take the mesh
    StageTimings shares;                             ///< of the whole
    double bytes_per_face = 0;                       ///< at the peak, the mesh apart
};

/// Medians of so many rounds, in which ours and CGAL's turn is taken one after the other, so that both meet the same
/// machine.
Measured measure(const fs::path& file, int rounds) {
    Measured out;
    TriangleMesh<double> mesh;
    std::vector<double> read, whole, cgal;
    std::size_t nodes = 1; // of its curve
    std::array<std::vector<double>, 5> stages;
    for (int round = 0; round < rounds; ++round) read.push_back(time_of([&] { mesh = read_mesh<double>(file); }));
    out.faces = static_cast<double>(mesh.faces.rows());
    std::optional<bench::CgalSkeletonizer> other;
    if (mesh.faces.rows() <= most_for_cgal) other.emplace(mesh);
    if (other && !other->is_closed()) other.reset();
    out.bytes_per_face = peak_bytes(mesh) / out.faces;
    for (int round = 0; round < rounds; ++round) {
        StageTimings timings;
        whole.push_back(time_of([&] { timings = extract_skeleton(mesh, joints_alone()).timings; }));
        const std::array<double, 5> parts{timings.surface, timings.curve, timings.embed, timings.refine, timings.sides};
        for (std::size_t i = 0; i < parts.size(); ++i) stages[i].push_back(parts[i] / timings.total);
        if (other) cgal.push_back(time_of([&] { nodes = other->run(); }));
    }
    if (nodes == 0) throw Error(ErrorCode::internal, "CGAL found no curve in " + file.string());
    out.read = median(read);
    out.whole = median(whole);
    out.cgal = median(cgal);
    out.shares = {median(stages[0]), median(stages[1]), median(stages[2]), median(stages[3]), median(stages[4]), 1};
    return out;
}

void print_row(const std::string& name, const Measured& m) {
    const auto percent = [](double share) { return static_cast<int>(std::lround(100 * share)); };
    const std::string ratio = m.cgal > 0 ? std::to_string(m.whole / m.cgal).substr(0, 5) : "-";
    std::printf("| %s | %.0f | %.1f | %.0f | %d, %d, %d %% | %s | %.2f |\n", name.c_str(), m.faces, m.read, m.whole,
                percent(m.shares.surface), percent(m.shares.curve),
                percent(m.shares.embed + m.shares.refine + m.shares.sides), ratio.c_str(), m.bytes_per_face / 1024);
    std::fflush(stdout);
}

void print_head() {
    std::printf("| mesh | faces | read, ms | whole, ms | surface, curve, joints | of CGAL's curve | kB a face |\n"
                "|---|---|---|---|---|---|---|\n");
}

/// At most `count` of the files, evenly spaced in alphabetical order.
std::vector<fs::path> pick_files(const fs::path& folder, std::size_t count) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.size() <= count) return files;
    std::vector<fs::path> picked;
    for (std::size_t i = 0; i < count; ++i) picked.push_back(files[i * (files.size() - 1) / (count - 1)]);
    return picked;
}

/// The medians of a set's bodies.
Measured of_set(const fs::path& set, int rounds) {
    constexpr std::array fields{&Measured::faces, &Measured::read, &Measured::whole, &Measured::bytes_per_face};
    constexpr std::array stages{&StageTimings::surface, &StageTimings::curve, &StageTimings::embed,
                                &StageTimings::refine, &StageTimings::sides};
    std::array<std::vector<double>, fields.size()> values;
    std::array<std::vector<double>, stages.size()> shares;
    std::vector<double> ratios;
    for (const fs::path& file : pick_files(set, meshes_per_set)) {
        const Measured m = measure(file, rounds);
        for (std::size_t i = 0; i < fields.size(); ++i) values[i].push_back(m.*fields[i]);
        for (std::size_t i = 0; i < stages.size(); ++i) shares[i].push_back(m.shares.*stages[i]);
        if (m.cgal > 0) ratios.push_back(m.whole / m.cgal);
    }
    Measured out;
    for (std::size_t i = 0; i < fields.size(); ++i) out.*fields[i] = median(values[i]);
    for (std::size_t i = 0; i < stages.size(); ++i) out.shares.*stages[i] = median(shares[i]);
    if (!ratios.empty()) out.cgal = out.whole / median(ratios);
    return out;
}

/// Each face in four, through the middles of its edges.
TriangleMesh<double> in_four(const TriangleMesh<double>& mesh) {
    const std::vector<std::array<int, 2>> edges = core::edges_of(mesh.faces);
    const Eigen::Index n = mesh.vertices.rows();
    TriangleMesh<double> out;
    out.vertices.resize(n + static_cast<Eigen::Index>(edges.size()), 3);
    out.vertices.topRows(n) = mesh.vertices;
    for (std::size_t e = 0; e < edges.size(); ++e)
        out.vertices.row(n + static_cast<Eigen::Index>(e)) =
            (mesh.vertices.row(edges[e][0]) + mesh.vertices.row(edges[e][1])) / 2;
    const auto middle = [&](int a, int b) {
        const std::array<int, 2> edge{std::min(a, b), std::max(a, b)};
        return static_cast<int>(n + (std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin()));
    };
    out.faces.resize(4 * mesh.faces.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const int a = mesh.faces(f, 0), b = mesh.faces(f, 1), c = mesh.faces(f, 2);
        const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        out.faces.row(4 * f) << a, ab, ca;
        out.faces.row(4 * f + 1) << ab, b, bc;
        out.faces.row(4 * f + 2) << ca, bc, c;
        out.faces.row(4 * f + 3) << ab, bc, ca;
    }
    return out;
}

/// The slope of the line through logarithms of sizes and times: time grows as size to the power of it.
double growth_exponent(const std::vector<Measured>& rows) {
    double x = 0, y = 0, xx = 0, xy = 0;
    const auto n = static_cast<double>(rows.size());
    for (const Measured& m : rows) {
        const double size = std::log(m.faces), time = std::log(m.whole);
        x += size;
        y += time;
        xx += size * size;
        xy += size * time;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

/// Bodies of 25 thousand faces and more, each with twice those of the one before, up to `most`.
void measure_growth(double most, int rounds) {
    const fs::path file = fs::temp_directory_path() / ("skelgen-bench-" + std::to_string(::time(nullptr)) + ".off");
    std::array<TriangleMesh<double>, 2> meshes;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        meshes[i] = synth::synthesize_body({}, synth::named_pose("walk"), i == 0 ? 25000 : 50000).mesh;
    std::vector<Measured> rows;
    for (std::size_t i = 0; static_cast<double>(meshes[i % 2].faces.rows()) <= most; ++i) {
        TriangleMesh<double>& mesh = meshes[i % 2];
        write_mesh(file, mesh);
        rows.push_back(measure(file, mesh.faces.rows() > 500000 ? std::min(rounds, 3) : rounds));
        print_row("generated", rows.back());
        mesh = in_four(mesh);
    }
    fs::remove(file);
    if (rows.size() > 1)
        std::printf("\nThe whole grows as the number of faces to the power of %.2f.\n", growth_exponent(rows));
}

/// A folder of its own, which goes with this.
class ScratchFolder {
public:
    ScratchFolder() { fs::create_directories(path_); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() { fs::remove_all(path_); }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_ = fs::temp_directory_path() / ("skelgen-bench-" + std::to_string(::time(nullptr)));
};

/// The program from file to file, beside CGAL's reader alone, and by how much more it does of several bodies with two
/// jobs, which a machine of two processors or more shows.
void measure_program(fs::path body, int rounds) {
    constexpr int copies = 12;
    const ScratchFolder scratch;
    if (body.empty()) {
        body = scratch.path() / "generated.off";
        write_mesh(body, synth::synthesize_body({}, synth::named_pose("walk"), 14000).mesh);
    }
    const fs::path meshes = scratch.path() / "meshes";
    fs::create_directory(meshes);
    for (int i = 0; i < copies; ++i) fs::copy_file(body, meshes / (std::to_string(i) + body.extension().string()));
    std::vector<double> start, whole, reader, one_job, two_jobs;
    const auto batch = [&](const char* jobs) {
        return bench::run_program({"batch", meshes.string(), "-o", (scratch.path() / "out").string(), "--jobs", jobs})
            .wall;
    };
    for (int round = 0; round < 3 * rounds; ++round) {
        start.push_back(bench::run_program({"--version"}).cpu);
        whole.push_back(
            bench::run_program({"extract", body.string(), "-o", (scratch.path() / "body.json").string()}).cpu);
        reader.push_back(time_of([&] {
            if (bench::read_by_cgal(body) == 0) throw Error(ErrorCode::internal, "CGAL read no face");
        }));
    }
    for (int round = 0; round < rounds; ++round) {
        one_job.push_back(batch("1"));
        two_jobs.push_back(batch("2"));
    }
    std::printf("\nThe program starts in %.1f ms. %s takes it %.0f ms from file to file, %.2f times what CGAL's reader "
                "takes.\nTwo jobs do %.2f times what one does.\n",
                median(start), body.filename().c_str(), median(whole), median(whole) / median(reader),
                median(one_job) / median(two_jobs));
}

/// By how much sooner two threads are done with a body of 400 thousand faces than one.
void measure_threads(int rounds) {
    const TriangleMesh<double> mesh =
        in_four(in_four(synth::synthesize_body({}, synth::named_pose("walk"), 25000).mesh));
    std::array<std::vector<double>, 2> times;
    for (int round = 0; round < rounds; ++round)
        for (int threads : {1, 2}) {
            ExtractOptions options = joints_alone();
            options.threads = threads;
            const auto begin = std::chrono::steady_clock::now();
            [[maybe_unused]] const auto found = extract_skeleton(mesh, options);
            const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
            times[static_cast<std::size_t>(threads - 1)].push_back(taken.count());
        }
    std::printf("Two threads are %.2f times as fast on %ld faces.\n", median(times[0]) / median(times[1]),
                static_cast<long>(mesh.faces.rows()));
}

int run_benchmarks(int argc, char** argv) {
    int rounds = 5;
    double most = 3300000;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (std::string(argv[i]) == "--rounds") rounds = std::max(1, std::atoi(argv[i + 1]));
        if (std::string(argv[i]) == "--most-faces") most = std::atof(argv[i + 1]);
    }
    fs::path body; // the first set's first
    print_head();
    if (const char* bodies = std::getenv("SKELGEN_BODIES"); bodies != nullptr && *bodies != '\0') {
        std::vector<fs::path> sets;
        for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(bodies) / "meshes"))
            if (entry.is_directory()) sets.push_back(entry.path());
        std::sort(sets.begin(), sets.end());
        for (const fs::path& set : sets) print_row(set.filename().string(), of_set(set, rounds));
        if (!sets.empty()) body = pick_files(sets.front(), 2).front();
    }
    measure_growth(most, rounds);
    measure_threads(rounds);
    measure_program(body, rounds);
    return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run_benchmarks(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "skelgen-bench: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
