#include <cstddef>
#include <cstdint>

#include "expect.hpp"
#include <skelgen/io/curve_formats.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(data, size, [](std::string_view bytes) {
        if (bytes.empty()) return;
        using namespace skelgen::io;
        const std::string_view file = bytes.substr(1); // the first byte says in which format
        constexpr int formats = 4;
        switch (static_cast<unsigned char>(bytes.front()) % formats) {
        case 0:
            static_cast<void>(curve_from_json<double>(file));
            break;
        case 1:
            static_cast<void>(curve_from_obj<double>(file));
            break;
        case 2:
            static_cast<void>(curve_from_ply<double>(file));
            break;
        default:
            static_cast<void>(curve_from_swc<double>(file));
            break;
        }
    });
}
