#include <skelgen/io/npz.hpp>

#include <cstdint>
#include <cstring>
#include <string>

#include <skelgen/core/error.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::io;

namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t out = 0;
    for (std::size_t i = 4; i-- > 0;) out = out << 8U | static_cast<unsigned char>(bytes.at(at + i));
    return out;
}

} // namespace

TEST_CASE("npz: a file in an archive, byte by byte", "[io]") {
    const std::string bytes = format_npz({{"a", {{2}, {1.0, -2.0}, {}}}});
    CHECK(bytes.substr(0, 4) == "PK\x03\x04");
    const std::string name = bytes.substr(30, 5);
    CHECK(name == "a.npy");
    const std::size_t begin = 30 + name.size(), size = number_at(bytes, 18);
    CHECK(size == number_at(bytes, 22)); // nothing is compressed
    const std::string file = bytes.substr(begin, size);
    CHECK(file.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
    CHECK(file.find("{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }") == 10);
    CHECK((size - 16) % 64 == 0); // where numpy wants the data
    double values[2] = {};
    std::memcpy(values, file.data() + size - 16, 16);
    CHECK(values[0] == 1.0);
    CHECK(values[1] == -2.0);
    CHECK(bytes.substr(begin + size, 4) == "PK\x01\x02");
    CHECK(bytes.substr(bytes.size() - 22, 4) == "PK\x05\x06");
    CHECK(number_at(bytes, bytes.size() - 6) == begin + size);
}

TEST_CASE("npz: texts of any script, as code points", "[io]") {
    const std::string bytes = format_npz({{"t",
                                           {{2},
                                            {},
                                            {"\xc3\xa9\xf0\x9f\xa6\xb4", "\xff"
                                                                         "b"}}}});
    CHECK(bytes.find("'<U2'") != std::string::npos);
    const std::size_t end = 30 + 5 + number_at(bytes, 18);
    const std::uint32_t expected[4] = {0xe9, 0x1f9b4, 0xfffd, 'b'};
    for (std::size_t i = 0; i < 4; ++i) CHECK(number_at(bytes, end - 16 + 4 * i) == expected[i]);
}

TEST_CASE("npz: an array without bodies, and one whose shape is another", "[io]") {
    CHECK(format_npz({{"none", {{0, 21, 3}, {}, {}}}}).find("(0,21,3,)") != std::string::npos);
    CHECK_THROWS_AS(format_npz({{"a", {{3}, {1.0, 2.0}, {}}}}), Error);
    CHECK_THROWS_AS(format_npz({{"a", {{2}, {1.0, 2.0}, {"x", "y"}}}}), Error);
}
