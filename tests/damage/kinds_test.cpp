#include "damage/kinds.hpp"

#include <algorithm>
#include <numeric>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"

namespace {

using namespace skelgen;
using damage::Mesh;

io::GroundTruth sample_truth() { return io::read_ground_truth(SKELGEN_DATA "/sample/body.json"); }

/// The sample body with its joints.
const damage::Subject& sample() {
    static const damage::Subject subject = [] {
        damage::Subject made{io::read_mesh<double>(SKELGEN_DATA "/sample/body.off"), KinematicSkeleton<double>(), 1};
        for (const auto& [name, position] : sample_truth().joints)
            made.skeleton->joints.push_back({name, -1, position, 0.0, 1.0});
        return made;
    }();
    return subject;
}

Mesh damaged(const char* kind) { return damage::damaged(damage::named_kind(kind), sample()); }

/// Connected by shared vertices; vertices that no face uses do not count.
int pieces(const Mesh& mesh) {
    std::vector<int> root(static_cast<std::size_t>(mesh.vertices.rows()));
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int v) {
        while (root[static_cast<std::size_t>(v)] != v) v = root[static_cast<std::size_t>(v)];
        return v;
    };
    std::set<int> roots;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 1; k < 3; ++k) root[static_cast<std::size_t>(find(mesh.faces(f, k)))] = find(mesh.faces(f, 0));
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) roots.insert(find(mesh.faces(f, 0)));
    return static_cast<int>(roots.size());
}

/// How many edges have that many faces.
int edges_with(const Mesh& mesh, int faces) {
    std::map<std::pair<int, int>, int> count;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) ++count[std::minmax({mesh.faces(f, k), mesh.faces(f, (k + 1) % 3)})];
    return static_cast<int>(
        std::count_if(count.begin(), count.end(), [&](const auto& edge) { return edge.second == faces; }));
}

double area(const Mesh& mesh) { return core::surface_area(mesh); }
double volume(const Mesh& mesh) { return core::enclosed_volume(mesh); }

TEST_CASE("every damage gives another mesh, the same each time, and names only vertices that are there") {
    for (const damage::Kind& kind : damage::kinds()) {
        CAPTURE(kind.name);
        const Mesh once = damage::damaged(kind, sample()), again = damage::damaged(kind, sample());
        if (kind.name != std::string("huge"))
            CHECK(volume(once) == Approx(volume(again))); // whose cubes are no numbers
        CHECK(once.faces.rows() == again.faces.rows());
        if (kind.name !=
            std::string("plate-grown")) { // whose new vertices CGAL numbers by where its boxes are in memory
            CHECK(once.vertices == again.vertices);
            CHECK(once.faces == again.faces);
        }
        const bool is_same = once.vertices.rows() == sample().mesh.vertices.rows() &&
                             once.vertices == sample().mesh.vertices && once.faces == sample().mesh.faces;
        CHECK_FALSE(is_same);
        CHECK(once.vertices.allFinite());
        CHECK(once.faces.minCoeff() >= 0);
        CHECK(once.faces.maxCoeff() < once.vertices.rows());
    }
}

TEST_CASE("another seed damages elsewhere") {
    damage::Subject other = sample();
    other.seed = 2;
    for (const char* name : {"flipped", "faces-gone", "noise-1", "far-100"}) {
        const Mesh a = damaged(name), b = damage::damaged(damage::named_kind(name), other);
        CHECK_FALSE((a.vertices == b.vertices && a.faces == b.faces));
    }
}

TEST_CASE("faces turned over keep the area and change the volume's sign") {
    CHECK(volume(damaged("inside-out")) == Approx(-volume(sample().mesh)));
    CHECK(volume(damaged("mirrored")) == Approx(volume(sample().mesh)));
    const Mesh flipped = damaged("flipped");
    CHECK(area(flipped) == Approx(area(sample().mesh)));
    Eigen::Index turned = 0;
    for (Eigen::Index f = 0; f < flipped.faces.rows(); ++f)
        turned += flipped.faces.row(f) == sample().mesh.faces.row(f) ? 0 : 1;
    CHECK(static_cast<double>(turned) == Approx(0.3 * static_cast<double>(flipped.faces.rows())).margin(1));
}

TEST_CASE("a surface torn apart stays where it was") {
    for (const auto& [name, count] : {std::pair{"soup-off", 0}, {"charts", 6}}) {
        const Mesh torn = damaged(name);
        CHECK(torn.faces.rows() == sample().mesh.faces.rows());
        CHECK(area(torn) == Approx(area(sample().mesh)));
        CHECK(volume(torn) == Approx(volume(sample().mesh)));
        CHECK(pieces(torn) == (count > 0 ? count : torn.faces.rows()));
    }
}

TEST_CASE("duplicates, faces without area and fins come on top") {
    const double vertices = static_cast<double>(sample().mesh.vertices.rows());
    const double faces = static_cast<double>(sample().mesh.faces.rows());
    const Mesh doubled = damaged("duplicates");
    CHECK(static_cast<double>(doubled.vertices.rows()) == Approx(1.05 * vertices).margin(1));
    CHECK(static_cast<double>(doubled.faces.rows()) == Approx(1.1 * faces).margin(1));

    const Mesh degenerate = damaged("degenerate");
    Eigen::Index without_area = 0;
    for (Eigen::Index f = 0; f < degenerate.faces.rows(); ++f)
        without_area += core::face_area_vector(degenerate, f).norm() < 1e-12 ? 1 : 0;
    CHECK(static_cast<double>(without_area) >= 0.03 * faces);

    const Mesh finned = damaged("fins");
    CHECK(static_cast<double>(finned.faces.rows()) == Approx(1.02 * faces).margin(1));
    CHECK(edges_with(finned, 3) > 0.01 * faces);
}

TEST_CASE("as much is lost as is said") {
    const double faces = static_cast<double>(sample().mesh.faces.rows());
    CHECK(static_cast<double>(damaged("faces-gone").faces.rows()) == Approx(0.95 * faces).margin(1));
    const double left = area(damaged("holes")) / area(sample().mesh);
    CHECK(left < 0.99); // five holes may overlap
    CHECK(left > 0.945);
}

TEST_CASE("limbs that are cut off are gone, and nothing else is") {
    const auto nearest = [](const Mesh& mesh, const std::string& joint) {
        for (const auto& [name, position] : sample_truth().joints)
            if (name == joint) return (mesh.vertices.rowwise() - position.transpose()).rowwise().norm().minCoeff();
        throw Error(ErrorCode::internal, "the sample has no joint " + joint);
    };
    for (const damage::Kind& kind : damage::kinds()) {
        if (kind.missing.empty()) continue;
        CAPTURE(kind.name);
        const Mesh mesh = damage::damaged(kind, sample());
        CHECK(pieces(mesh) == 1);
        CHECK(area(mesh) < 0.99 * area(sample().mesh));
        for (const auto& [name, position] : sample_truth().joints) {
            const bool is_cut = std::find(kind.missing.begin(), kind.missing.end(), name) != kind.missing.end();
            // Hands and feet alone: what is next to a cut may be as near to its rim as to the surface before.
            if (name.find("hand") == std::string::npos && name.find("foot") == std::string::npos) continue;
            CHECK((nearest(mesh, name) > 1.2 * nearest(sample().mesh, name)) == is_cut);
        }
    }
    const Mesh front = damaged("front-half");
    CHECK(area(front) < 0.6 * area(sample().mesh));
    CHECK(area(front) > 0.4 * area(sample().mesh));
}

TEST_CASE("noise has the root mean square that is said, of the diagonal") {
    for (const auto& [name, part] : {std::pair{"noise-1", 0.01}, {"noise-2", 0.02}}) {
        const Mesh noisy = damaged(name);
        const double mean_square = (noisy.vertices - sample().mesh.vertices).rowwise().squaredNorm().mean();
        CHECK(std::sqrt(mean_square) == Approx(part * core::bounding_diagonal(sample().mesh.vertices)).epsilon(0.02));
    }
}

TEST_CASE("what is added around a body leaves the body alone") {
    for (const char* name : {"far-unused", "floating", "plate-apart", "two-bodies"}) {
        CAPTURE(name);
        const Mesh mesh = damaged(name);
        CHECK(mesh.vertices.topRows(sample().mesh.vertices.rows()) == sample().mesh.vertices);
        CHECK(mesh.faces.topRows(sample().mesh.faces.rows()) == sample().mesh.faces);
    }
    CHECK(pieces(damaged("far-unused")) == 1);
    CHECK(pieces(damaged("floating")) == 11);
    CHECK(pieces(damaged("plate-apart")) == 2);
    CHECK(pieces(damaged("two-bodies")) == 2);
    // The sample stands on z = 0; its plate does not reach it.
    const Mesh plate = damaged("plate-apart");
    CHECK(plate.vertices.bottomRows(8).col(2).maxCoeff() < sample().mesh.vertices.col(2).minCoeff());
}

TEST_CASE("a far vertex is as far away as is said") {
    const Mesh& body = sample().mesh;
    const double length = (body.vertices.colwise().maxCoeff() - body.vertices.colwise().minCoeff()).maxCoeff();
    for (const auto& [name, lengths] : {std::pair{"far-100", 100.0}, {"far-1000", 1000.0}}) {
        const Mesh mesh = damaged(name);
        const Eigen::Index last = mesh.vertices.rows() - 1;
        CHECK((mesh.faces.array() == static_cast<int>(last)).count() == 1);
        CHECK((mesh.vertices.row(last) - body.vertices.row(0)).norm() == Approx(lengths * length).epsilon(0.02));
    }
}

TEST_CASE("a plate grown to the soles is one closed surface with the body") {
    const Mesh mesh = damaged("plate-grown");
    CHECK(pieces(mesh) == 1);
    CHECK(test::is_closed(mesh.faces));
    CHECK(volume(mesh) > volume(sample().mesh));
}

TEST_CASE("parts are closed, as many as is said, and reach into each other") {
    for (const auto& [name, count] : {std::pair{"parts-14", 14}, {"parts-4", 4}}) {
        const Mesh mesh = damaged(name);
        CHECK(pieces(mesh) == count);
        CHECK(test::is_closed(mesh.faces));
        CHECK(volume(mesh) > volume(sample().mesh));
    }
}

TEST_CASE("inner walls close each of the 13 cuts by one more face along every edge of it") {
    const Mesh mesh = damaged("inner-walls");
    CHECK(mesh.vertices.rows() == sample().mesh.vertices.rows() + 13);
    CHECK(edges_with(mesh, 1) == 0);
    CHECK(edges_with(mesh, 3) == mesh.faces.rows() - sample().mesh.faces.rows());
}

TEST_CASE("resolutions have the number of faces that is said, and stay closed") {
    for (const auto& [name, faces] :
         {std::pair{"faces-3000", 3000.0}, {"faces-1000", 1000.0}, {"faces-500", 500.0}, {"faces-400000", 400000.0}}) {
        const Mesh mesh = damaged(name);
        CHECK(static_cast<double>(mesh.faces.rows()) == Approx(faces).margin(2));
        CHECK(test::is_closed(mesh.faces));
        CHECK(volume(mesh) == Approx(volume(sample().mesh)).epsilon(0.02));
    }
}

TEST_CASE("a mirrored body's left is where its right was") {
    const io::GroundTruth before = sample_truth();
    const io::GroundTruth after = damage::truth_after(damage::named_kind("mirrored"), before);
    const Vector3<double> right = before.markers.at("right_hand");
    CHECK(after.markers.at("left_hand") == Vector3<double>(-right.x(), right.y(), right.z()));
    CHECK(after.joints.size() == before.joints.size());
    CHECK(damage::truth_after(damage::named_kind("fins"), before).markers == before.markers);
}

TEST_CASE("what is no surface any more is refused as such, whatever is to be found in it") {
    int refused = 0;
    for (const damage::Kind& kind : damage::kinds()) {
        if (kind.is_surface) continue;
        CAPTURE(kind.name);
        ++refused;
        const Mesh mesh = damage::damaged(kind, sample());
        const char* why = kind.name == "tiny"   ? "too small"
                          : kind.name == "huge" ? "too large"
                                                : "vertices that are far apart";
        CHECK_THROWS_WITH(extract_skeleton(mesh), Catch::Contains(why));
        CHECK_THROWS_WITH(find_curves(mesh), Catch::Contains(why));
        CHECK_THROWS_WITH(find_curve_skeleton(mesh), Catch::Contains(why));
    }
    CHECK(refused == 5);
}

TEST_CASE("a body of which some faces are between random vertices is a surface all the same") {
    damage::Subject subject = sample();
    const Mesh random = damaged("random-faces");
    for (Eigen::Index f = 0; f < subject.mesh.faces.rows(); f += 100) subject.mesh.faces.row(f) = random.faces.row(f);
    CHECK_NOTHROW(surface::require_surface(subject.mesh));
    CHECK_NOTHROW(surface::require_surface(sample().mesh));
    for (const double scale : {1e-30, 1e30}) {
        Mesh scaled = sample().mesh;
        scaled.vertices *= scale;
        CHECK_NOTHROW(surface::require_surface(scaled));
    }
}

TEST_CASE("damages that cannot be made are refused with the reason") {
    damage::Subject bare = sample();
    bare.skeleton.reset();
    CHECK_THROWS_WITH(damage::damaged(damage::named_kind("parts-14"), bare), Catch::Contains("skeleton"));
    CHECK_THROWS_WITH(damage::named_kind("rust"), Catch::Contains("there is no damage rust"));
    CHECK_THROWS_AS(damage::damaged(damage::named_kind("fins"), {}), Error);
    damage::Subject legless = sample();
    std::erase_if(legless.skeleton->joints, [](const auto& joint) { return joint.name == "left_knee"; });
    CHECK_THROWS_WITH(damage::damaged(damage::named_kind("parts-4"), legless), Catch::Contains("left_knee"));
    damage::Subject open = sample();
    open.mesh = damaged("holes");
    CHECK_THROWS_WITH(damage::damaged(damage::named_kind("plate-grown"), open), Catch::Contains("boundary"));
}

} // namespace
