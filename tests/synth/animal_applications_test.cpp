// What a skeleton is good for, of generated animals.

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <Eigen/Geometry>

#include <skelgen/applications/alignment.hpp>
#include <skelgen/applications/correspondence.hpp>
#include <skelgen/applications/measurement.hpp>
#include <skelgen/applications/pose_transfer.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/applications/segmentation.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/synth/quadrupeds.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::synth;

namespace {

using Place = Vector3<double>;

struct Animal {
    QuadrupedPlan plan;
    Extraction<double> found;
};

/// The skeleton is that of the plan: what is tested here is what comes after.
Animal animal(std::size_t number) {
    Animal out{quadruped_plans(1, number + 1).back(), {}};
    const TriangleMesh<double> mesh = synthesize_quadruped(out.plan, 6000);
    ExtractOptions options;
    options.skeleton_template = builtin_template("quadruped");
    out.found = extract(mesh, options);
    for (Joint<double>& joint : out.found.skeleton.joints)
        for (const auto& [name, place] : out.plan.joints)
            if (joint.name == name) joint.position = place;
    return out;
}

const Animal& dog() {
    static const Animal one = animal(0); // it stands
    return one;
}

const Animal& cat() {
    static const Animal one = animal(2); // it gallops
    return one;
}

Place joint_of(const KinematicSkeleton<double>& skeleton, const std::string& name) {
    return skeleton.joints.at(static_cast<std::size_t>(find_joint(skeleton, name))).position;
}

} // namespace

TEST_CASE("an animal's parts are where its bones are") {
    const auto parts = applications::segment(dog().found.body, dog().found.skeleton);
    REQUIRE(parts.parts == applications::part_names(applications::PartSet::bones, BodyKind::quadruped));
    const Body<double>& body = dog().found.body;
    const auto part_near = [&](const Place& place) {
        const int v = body.tree.nearest_corner(body.mesh, body.similarity.to_canonical(place));
        return parts.parts[static_cast<std::size_t>(parts.vertex_part[static_cast<std::size_t>(v)])];
    };
    const KinematicSkeleton<double>& skeleton = dog().found.skeleton;
    for (const auto& [name, place] : dog().plan.end_points) {
        INFO(name);
        const bool is_fore = name.ends_with("fore_toe"), is_hind = name.ends_with("hind_toe");
        const std::string side(side_prefix(split_side(name).side));
        CHECK(part_near(place) == (is_fore   ? side + "fore_foot"
                                   : is_hind ? side + "hind_foot"
                                             : name.substr(0, name.find('_'))));
    }
    for (const std::string side : {"left_", "right_"})
        for (const std::string leg : {"fore", "hind"}) {
            INFO(side + leg);
            const Place knee = joint_of(skeleton, side + leg + "_lower"),
                        ankle = joint_of(skeleton, side + leg + "_ankle");
            CHECK(part_near((knee + ankle) / 2) == side + leg + "_lower");
        }
    CHECK(part_near((joint_of(skeleton, "spine1") + joint_of(skeleton, "spine2")) / 2) == "abdomen");
    CHECK(part_near(joint_of(skeleton, "neck2")) == "neck");
    std::set<int> there(parts.vertex_part.begin(), parts.vertex_part.end());
    CHECK(there.size() == parts.parts.size());
    const auto coarse = applications::segment(dog().found.body, skeleton, applications::PartSet::body);
    CHECK(coarse.parts.size() == 15);
    CHECK(coarse.parts[2] == "tail");
}

TEST_CASE("an animal's measures are its bones' lengths, its height at the withers, and girths") {
    const auto parts = applications::segment(dog().found.body, dog().found.skeleton);
    const auto measures = applications::measure(dog().found.body, dog().found.skeleton, parts);
    std::map<std::string, double> lengths(measures.lengths.begin(), measures.lengths.end());
    const auto at = [&](const std::string& name) {
        for (const auto& [joint, place] : dog().plan.joints)
            if (joint == name) return place;
        throw std::runtime_error("no " + name);
    };
    CHECK(lengths.at("left_hind_lower") == Approx((at("left_hind_lower") - at("left_hind_ankle")).norm()));
    CHECK(lengths.at("upper_neck") == Approx((at("neck2") - at("head")).norm()));
    CHECK(measures.arm_span == 0);
    const double top = dog().found.mesh.vertices.col(2).maxCoeff();
    CHECK(measures.height > 0.6 * top); // with the head above
    CHECK(measures.height < top);
    std::map<std::string, std::optional<double>> girths(measures.girths.begin(), measures.girths.end());
    REQUIRE(girths.size() == 7);
    for (const auto& [name, girth] : girths) {
        INFO(name);
        REQUIRE(girth);
    }
    CHECK(*girths.at("chest") > *girths.at("neck"));
    CHECK(*girths.at("neck") > *girths.at("left_fore_lower"));
    CHECK(*girths.at("left_hind_lower") == Approx(*girths.at("right_hind_lower")).epsilon(0.1));
}

TEST_CASE("animals are aligned by their trunks: up is up, the head in front") {
    for (const Animal* one : {&dog(), &cat()}) {
        INFO(one->plan.body.name);
        const Eigen::Matrix4d transform =
            applications::alignment(one->found.body, one->found.skeleton, one->found.mesh.vertices);
        const auto moved = [&](const std::string& name) -> Place {
            return (transform * joint_of(one->found.skeleton, name).homogeneous()).head<3>();
        };
        CHECK(moved("hips").norm() < 1e-9);
        CHECK(moved("head").z() > moved("chest").z());
        CHECK(std::abs(moved("chest").y()) < 0.05 * moved("chest").z());
        CHECK(moved("left_hind_upper").x() > moved("right_hind_upper").x());
        CHECK(moved("left_fore_lower").y() < moved("left_fore_upper").y());
    }
}

TEST_CASE("animals correspond: limbs to limbs, left to left, head and tail to their own") {
    const auto from = applications::comparable(dog().found.body, dog().found.skeleton),
               to = applications::comparable(cat().found.body, cat().found.skeleton);
    const auto found = applications::correspond(from, to);
    std::size_t same = 0;
    for (std::size_t v = 0; v < found.map.size(); ++v)
        same += from.parts.vertex_part[v] == to.parts.vertex_part[static_cast<std::size_t>(found.map[v])] ? 1 : 0;
    CHECK(static_cast<double>(same) > 0.8 * static_cast<double>(found.map.size()));
    const std::vector<std::string>& names = from.parts.parts;
    for (std::size_t v = 0; v < found.map.size(); ++v) {
        const std::string
            &own = names[static_cast<std::size_t>(from.parts.vertex_part[v])],
            &other = names[static_cast<std::size_t>(to.parts.vertex_part[static_cast<std::size_t>(found.map[v])])];
        const bool are_feet = own.ends_with("_foot") && other.ends_with("_foot");
        if (are_feet) CHECK(own == other);
    }
    auto person = to;
    person.parts.parts = applications::part_names(applications::PartSet::bones);
    CHECK_THROWS_AS(applications::correspond(from, person), Error);
}

TEST_CASE("a dog that is held as a galloping cat has its bones point where the cat's do") {
    const SkeletonTemplate& own = builtin_template("quadruped");
    const auto held =
        applications::pose_like(dog().found.mesh, dog().found.body, dog().found.skeleton, cat().found.skeleton, own);
    const auto bone = [](const KinematicSkeleton<double>& skeleton, const char* from, const char* to) -> Place {
        return (joint_of(skeleton, to) - joint_of(skeleton, from)).normalized();
    };
    for (const auto& [from, to] : {std::pair("left_fore_lower", "left_fore_ankle"),
                                   {"right_fore_lower", "right_fore_ankle"},
                                   {"left_hind_lower", "left_hind_ankle"},
                                   {"right_hind_upper", "right_hind_lower"}}) {
        INFO(from);
        CHECK(bone(held.skeleton, from, to).dot(bone(cat().found.skeleton, from, to)) > 0.95);
    }
    CHECK(held.mesh.vertices.allFinite());
}

TEST_CASE("an animal's rig has the names of Mesh2Motion's fox and horse") {
    const auto rig =
        applications::make_rig(dog().found.mesh, dog().found.body, dog().found.skeleton, builtin_template("quadruped"));
    const auto names = [&](const char* convention) {
        const auto all = io::names_of(rig.joints, *io::joint_names_named(convention));
        CHECK(std::set<std::string>(all.begin(), all.end()).size() == all.size());
        return std::set<std::string>(all.begin(), all.end());
    };
    const auto fox = names("mesh2motion-fox"), horse = names("mesh2motion-horse");
    for (const char* name : {"Hips", "Spine_2.001", "Front_Leg_Ankle_L", "Back_Leg_Foot_1_R", "Tail_End", "Ear_L"})
        CHECK(fox.count(name) == 1);
    for (const char* name : {"hips", "spine_4", "front_humerus_l", "back_leg_toe_r", "tail_4", "ear_1_r"})
        CHECK(horse.count(name) == 1);
    double least = 1;
    for (Eigen::Index v = 0; v < rig.mesh.vertices.rows(); ++v) least = std::min(least, rig.skin.weights.row(v).sum());
    CHECK(least > 0.999);
}
