#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/read_file.hpp>
#include <skelgen/io/read_mesh.hpp>
#include <skelgen/io/write_mesh.hpp>

#include "catch.hpp"
#include "io/gzip.hpp"
#include "io/mesh_expectations.hpp"
#include "temporary_folder.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;

#if SKELGEN_WITH_ZLIB

TEST_CASE("gzip: every format is read and written compressed", "[codecs][gzip]") {
    const TemporaryFolder folder;
    for (const char* name : {"a.off.gz", "a.OBJ.GZ", "a.ply.gz", "a.stl.gz", "a.glb.gz"}) {
        INFO(name);
        write_mesh(folder / name, tetrahedron());
        CHECK(detail::is_gzip(read_file(folder / name)));
        CHECK(read_mesh(folder / name).faces.rows() == 4);
    }
    CHECK_THROWS_AS(write_mesh(folder / "a.gz", tetrahedron()), Error);
    write_file_atomically(folder / "unnamed", detail::gzip(format_mesh(tetrahedron(), MeshFormat::off)));
    check_same(read_mesh(folder / "unnamed"), tetrahedron()); // what the file holds counts
}

TEST_CASE("gzip: long and several parts come back, damaged and cut ones do not", "[codecs][gzip]") {
    std::string bytes;
    for (int i = 0; i < 200000; ++i) bytes += std::to_string(i * 7919 % 100003);
    constexpr std::size_t limit = std::size_t{1} << 30U;
    CHECK((detail::gunzip(detail::gzip(bytes), limit) == bytes));
    CHECK((detail::gunzip(detail::gzip(bytes) + detail::gzip("more"), limit) == bytes + "more"));
    CHECK((detail::gunzip(detail::gzip("one") + std::string(10, '\0'), limit) == "one"));
    CHECK((detail::gunzip(detail::gzip(""), limit).empty()));
    CHECK((detail::gzip(bytes) == detail::gzip(bytes)));

    const std::string small = detail::gzip(format_mesh(tetrahedron(), MeshFormat::off));
    for (std::size_t size = 2; size < small.size(); ++size)
        CHECK_THROWS_AS(detail::gunzip(small.substr(0, size), limit), Error);
    for (std::size_t i = 0; i < small.size(); ++i) {
        std::string changed = small;
        changed[i] = static_cast<char>(changed[i] ^ 0x15);
        try {
            static_cast<void>(parse_mesh(changed));
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::bad_input);
        }
    }
}

TEST_CASE("gzip: bombs are not unpacked", "[codecs][gzip]") {
    const std::string bomb = detail::gzip(std::string(50 << 20, ' '));
    REQUIRE(bomb.size() < 100000);
    CHECK_THAT(reading_error(bomb), Catch::Matchers::Contains("decompress"));
    CHECK_THROWS_AS(detail::gunzip(detail::gzip(std::string(3000, 'x')), 2000), Error);
}

#endif
