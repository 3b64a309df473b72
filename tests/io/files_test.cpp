#include <algorithm>
#include <string>
#include <thread>

#include <sys/stat.h>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/mesh_format.hpp>
#include <skelgen/io/read_file.hpp>

#include "catch.hpp"
#include "temporary_folder.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
namespace fs = std::filesystem;

TEST_CASE("read_file: every byte comes back, of files and of pipes", "[io][files]") {
    const TemporaryFolder folder;
    std::string bytes(300000, 'x'); // more than is read at a time
    bytes[7] = '\0';
    bytes[200000] = '\xff';
    write_file_atomically(folder / "file", bytes);
    const bool same = read_file(folder / "file") == bytes; // not in the CHECK: it would print the file
    CHECK(same);
    write_file_atomically(folder / "empty", "");
    CHECK(read_file(folder / "empty").empty());

    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    std::thread writer([&] { write_file_atomically(folder / "pipe", bytes); });
    const std::string received = read_file(folder / "pipe");
    writer.join();
    const bool same_from_pipe = received == bytes;
    CHECK(same_from_pipe);
}

TEST_CASE("read_file: what is no file is bad input", "[io][files]") {
    const TemporaryFolder folder;
    for (const fs::path& path : {folder / "missing", folder.path(), folder / "missing/below", fs::path()}) {
        INFO(path);
        try {
            (void)read_file(path);
            FAIL_CHECK("was read");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::bad_input);
        }
    }
}

TEST_CASE("mesh formats: the list of extensions is the one that names are judged by", "[io][files]") {
    const auto extensions = mesh_extensions();
    REQUIRE(extensions.size() == 9);
    for (std::size_t i = 0; i < extensions.size(); ++i) {
        std::string upper(extensions[i]);
        std::transform(upper.begin(), upper.end(), upper.begin(), [](char c) { return c == '.' ? c : char(c - 32); });
        CHECK(mesh_format_of("a" + std::string(extensions[i])) == static_cast<MeshFormat>(i));
        CHECK(mesh_format_of("folder.x/a.b" + upper) == static_cast<MeshFormat>(i));
    }
    CHECK(mesh_extensions_text() == ".off, .obj, .ply, .stl, .glb, .gltf, .vrm, .fbx or .dae");
    CHECK(written_mesh_extensions_text() == ".off, .obj, .ply, .stl, .glb or .fbx");
    CHECK(mesh_format_of("a.off.gz") == MeshFormat::off);
    CHECK(mesh_format_of("a.b.PLY.GZ") == MeshFormat::ply);
    CHECK_FALSE(mesh_format_of("off.gz").has_value());
    CHECK(mesh_format_named("GlTF") == MeshFormat::gltf);
    CHECK_FALSE(mesh_format_named("").has_value());
    CHECK(without_extensions("f/a.off.gz") == "f/a");
    CHECK(without_extensions("f/a.b.obj") == "f/a.b");
    CHECK(without_extensions("f.g/a.txt") == "f.g/a");
    CHECK_FALSE(mesh_format_of("a.ofx").has_value());
}
