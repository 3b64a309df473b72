#include <cstddef>
#include <cstdint>

#include <skelgen/io/read_clip.hpp>

#include "expect.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        // FBX and DAE are read in another process.
        if (bytes.find("FBX") != std::string_view::npos || bytes.find("COLLADA") != std::string_view::npos) return;
        const auto clip = skelgen::io::parse_clip(bytes);
        skelgen::fuzz::expect(!clip.joints.empty() && clip.frames.rows() > 0 && clip.frames.allFinite());
        for (const auto& place : pose_in(clip, 0).positions) skelgen::fuzz::expect(place.allFinite());
    });
}
