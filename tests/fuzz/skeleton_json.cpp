#include <cstddef>
#include <cstdint>

#include "expect.hpp"
#include <skelgen/io/skeleton_json.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return skelgen::fuzz::run(
        data, size, [](std::string_view bytes) { static_cast<void>(skelgen::io::parse_skeleton_document(bytes)); });
}
