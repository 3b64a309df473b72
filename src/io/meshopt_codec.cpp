#include "meshopt_codec.hpp"

#include <skelgen/core/error.hpp>

#if SKELGEN_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>

#include "loaded_library.hpp"
#endif

namespace skelgen::io::detail {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, "glTF: " + message); }

} // namespace

#if SKELGEN_WITH_MESHOPTIMIZER

namespace {

[[noreturn]] void refuse_damaged() {
    refuse("a part compressed with EXT_meshopt_compression is damaged; export the scene again");
}

/// What the decoder takes for granted.
bool is_sound(const MeshoptStream& stream) {
    // Zeros take two bits of every sixteen bytes, a triangle one byte: nothing shrinks further.
    constexpr std::size_t best_ratio = 128;
    if (stream.stride == 0 || stream.stride > 256 || stream.count > best_ratio * stream.bytes.size() / stream.stride)
        return false;
    if (stream.mode == MeshoptMode::attributes) return stream.stride % 4 == 0;
    return (stream.stride == 2 || stream.stride == 4) && (stream.mode == MeshoptMode::indices || stream.count % 3 == 0);
}

bool is_sound_filter(const MeshoptStream& stream) {
    switch (stream.filter) {
    case MeshoptFilter::none:
        return true;
    case MeshoptFilter::octahedral:
        return stream.mode == MeshoptMode::attributes && (stream.stride == 4 || stream.stride == 8);
    case MeshoptFilter::quaternion:
        return stream.mode == MeshoptMode::attributes && stream.stride == 8;
    case MeshoptFilter::exponential:
        break;
    }
    return stream.mode == MeshoptMode::attributes;
}

using Decoder = int(void* rows, std::size_t count, std::size_t stride, const unsigned char* bytes, std::size_t size);
using Filter = void(void* rows, std::size_t count, std::size_t stride);
// By names alone no type can be told: the header overloads them.
static_assert(requires(Decoder * &decoder, Filter*& filter) {
    decoder = meshopt_decodeVertexBuffer;
    decoder = meshopt_decodeIndexBuffer;
    decoder = meshopt_decodeIndexSequence;
    filter = meshopt_decodeFilterOct;
    filter = meshopt_decodeFilterQuat;
    filter = meshopt_decodeFilterExp;
});

LoadedLibrary load_library() {
    return {
        SKELGEN_MESHOPTIMIZER_LIBRARY,
        "glTF: the scene is compressed with EXT_meshopt_compression, for which the library meshoptimizer is missing "
        "(" SKELGEN_MESHOPTIMIZER_LIBRARY
        "); install it (Debian: libmeshoptimizer2d), or export the scene uncompressed"};
}

int decode(const LoadedLibrary& meshoptimizer, const MeshoptStream& stream, char* rows) {
    const auto with = [&](Decoder* decoder) {
        const auto* const bytes = reinterpret_cast<const unsigned char*>(stream.bytes.data());
        return decoder(rows, stream.count, stream.stride, bytes, stream.bytes.size());
    };
    switch (stream.mode) {
    case MeshoptMode::attributes:
        return with(meshoptimizer.function<Decoder>("meshopt_decodeVertexBuffer"));
    case MeshoptMode::triangles:
        return with(meshoptimizer.function<Decoder>("meshopt_decodeIndexBuffer"));
    case MeshoptMode::indices:
        break;
    }
    return with(meshoptimizer.function<Decoder>("meshopt_decodeIndexSequence"));
}

void apply_filter(const LoadedLibrary& meshoptimizer, const MeshoptStream& stream, char* rows) {
    const auto with = [&](Filter* filter) { filter(rows, stream.count, stream.stride); };
    switch (stream.filter) {
    case MeshoptFilter::none:
        return;
    case MeshoptFilter::octahedral:
        return with(meshoptimizer.function<Filter>("meshopt_decodeFilterOct"));
    case MeshoptFilter::quaternion:
        return with(meshoptimizer.function<Filter>("meshopt_decodeFilterQuat"));
    case MeshoptFilter::exponential:
        return with(meshoptimizer.function<Filter>("meshopt_decodeFilterExp"));
    }
}

} // namespace

std::string decode_meshopt(const MeshoptStream& stream, std::size_t most_bytes) {
    if (!is_sound(stream) || !is_sound_filter(stream)) refuse_damaged();
    if (stream.count * stream.stride > most_bytes)
        refuse("parts compressed with EXT_meshopt_compression become far too large; export the scene uncompressed");
    std::string rows(stream.count * stream.stride, '\0');
    static const LoadedLibrary meshoptimizer = load_library();
    if (decode(meshoptimizer, stream, rows.data()) != 0) refuse_damaged();
    apply_filter(meshoptimizer, stream, rows.data());
    return rows;
}

#else

std::string decode_meshopt(const MeshoptStream&, std::size_t) {
    refuse(
        "the scene is compressed with EXT_meshopt_compression, which this build of skelgen cannot read; build it with "
        "meshoptimizer (Debian: libmeshoptimizer-dev), or export the scene uncompressed");
}

#endif

} // namespace skelgen::io::detail
