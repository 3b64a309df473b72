#include <cstddef>
#include <cstdint>

#include "expect.hpp"
#include <skelgen/applications/clip_body.hpp>
#include <skelgen/io/bvh.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        const auto clip = skelgen::io::parse_bvh(bytes);
        skelgen::fuzz::expect(!clip.joints.empty() && clip.frames.rows() > 0 && clip.frames.allFinite());
        for (const auto& place : pose_in(clip, 0).positions) skelgen::fuzz::expect(place.allFinite());
        if (const auto body = find_body(clip))
            skelgen::fuzz::expect(body->pelvis >= 0 && body->chest >= 0 && body->head >= 0);
    });
}
