#include <string>

#include <skelgen/applications/animation.hpp>
#include <skelgen/applications/clip_body.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/io/bvh.hpp>
#include <skelgen/io/read_clip.hpp>
#include <skelgen/io/rig_formats.hpp>

#include "applications/template_rig.hpp"
#include "catch.hpp"
#include "io/gltf_builder.hpp"
#include "shapes.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace skelgen;
using applications::Animation;
using applications::MotionClip;
using applications::Rig;

/// A box with the joints of human21.
Rig<double> boxed_rig() {
    Rig<double> rig;
    rig.mesh = test::box({0.2, 1.7, 0.3}, 2);
    rig.unit_is_known = true;
    rig.joints = test::template_joints();
    rig.skin =
        applications::strongest_influences<double>(Eigen::MatrixXd::Constant(rig.mesh.vertices.rows(), 21, 1.0 / 21));
    return rig;
}

/// Half a second in which all joints turn and the root moves.
Animation<double> waving(const Rig<double>& rig) {
    Animation<double> out{"waving", 1.0 / 30, {}};
    for (int i = 0; i < 15; ++i) {
        applications::RigPose<double> pose{Eigen::Vector3d(0.1 * i, 1, -0.05 * i), {}};
        for (std::size_t j = 0; j < rig.joints.size(); ++j)
            pose.axes.push_back(rig.joints[j].axes *
                                Eigen::AngleAxisd(0.1 * i + 0.05 * static_cast<double>(j), Eigen::Vector3d::UnitX()));
        out.frames.push_back(std::move(pose));
    }
    return out;
}

/// Whether a clip's joints are, in all its frames, where a rig's are, times `unit`.
void check_moves_as(const MotionClip& clip, const Rig<double>& rig, const Animation<double>& animation, double unit) {
    REQUIRE(clip.frames.rows() == static_cast<Eigen::Index>(animation.frames.size()));
    CHECK(clip.seconds_per_frame == Approx(1.0 / 30));
    CHECK(applications::find_body(clip));
    for (const std::size_t frame : {0U, 6U, 14U}) {
        const auto wanted = applications::motions(rig.joints, animation.frames[frame]);
        const auto pose = applications::pose_in(clip, frame);
        std::size_t compared = 0;
        for (std::size_t c = 0; c < clip.joints.size(); ++c)
            for (std::size_t j = 0; j < rig.joints.size(); ++j) {
                if (clip.joints[c].name != rig.joints[j].name) continue;
                ++compared;
                CHECK((pose.positions[c] - unit * wanted[j](rig.joints[j].position)).norm() < 1e-4 * unit);
                CHECK(pose.turns[c].angularDistance(wanted[j].rotation) < 1e-3);
            }
        CHECK(compared == 21);
    }
}

TEST_CASE("clips: the animation of a GLB", "[codecs][clip]") {
    const Rig<double> rig = boxed_rig();
    const Animation<double> animation = waving(rig);
    const std::string glb = io::rig_to_glb(rig, io::JointNames::skelgen, {}, {animation});
    check_moves_as(io::parse_clip(glb), rig, animation, 1);
    CHECK_THROWS_AS(io::parse_clip(io::rig_to_glb(rig)), Error); // nothing moves
    CHECK_THROWS_AS(io::parse_clip("neither"), Error);
}

TEST_CASE("clips: bones by the names that VRM's animations give them", "[codecs][clip]") {
    test::GltfBuilder scene;
    const auto times = scene.add<float>("SCALAR", {0, 0.5F});
    const auto turns = scene.add<float>("VEC4", {0, 0, 0, 1, 0, 0, 1, 0});
    scene.json["nodes"] = {{{"name", "a"}, {"children", {1}}},
                           {{"name", "b"}, {"translation", {0, 1, 0}}, {"children", {2}}},
                           {{"name", "c"}, {"translation", {0, 1, 0}}}};
    scene.json["animations"] = {{{"samplers", {{{"input", times}, {"output", turns}}}},
                                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    scene.json["extensions"]["VRMC_vrm_animation"]["humanoid"]["humanBones"] = {{"hips", {{"node", 0}}},
                                                                                {"spine", {{"node", 1}}}};
    const MotionClip clip = io::parse_clip(scene.glb());
    REQUIRE(clip.joints.size() == 2);
    CHECK(clip.joints[0].name == "hips");
    CHECK(clip.joints[1].name == "spine");
    REQUIRE(clip.frames.rows() == 16);
    CHECK((applications::pose_in(clip, 15).positions[1] - Eigen::Vector3d(0, -1, 0)).norm() < 1e-6);
    scene.json["extensions"]["VRMC_vrm_animation"]["humanoid"]["humanBones"]["hips"]["node"] = 7;
    CHECK_THROWS_AS(io::parse_clip(scene.glb()), Error);
}

TEST_CASE("clips: where a scene's rig is", "[codecs][clip]") {
    const Rig<double> rig = boxed_rig();
    const test::TemporaryFolder folder;
    io::write_rig(folder / "rig.glb", rig);
    const auto clip = io::read_rig(folder / "rig.glb");
    REQUIRE(clip);
    CHECK(clip->frames.rows() == 1);
    const auto places = applications::rest_pose(*clip).positions;
    for (std::size_t c = 0; c < clip->joints.size(); ++c)
        for (const auto& joint : rig.joints)
            if (joint.name == clip->joints[c].name) CHECK((places[c] - joint.position).norm() < 1e-5);
    io::write_rig(folder / "rig.bvh", rig);
    CHECK_FALSE(io::read_rig(folder / "rig.bvh"));
}

#if SKELGEN_WITH_ASSIMP

TEST_CASE("clips: the animation of an FBX, also by another process", "[codecs][clip][fbx]") {
    const Rig<double> rig = boxed_rig();
    const Animation<double> animation = waving(rig);
    const std::string fbx = io::rig_to_fbx(rig, io::JointNames::skelgen, {}, {animation});
    check_moves_as(io::parse_clip(fbx), rig, animation, 100);
    check_moves_as(io::parse_clip(fbx, true), rig, animation, 100);
}

#endif

} // namespace
