#include "gzip.hpp"

#include <skelgen/core/error.hpp>

#if SKELGEN_WITH_ZLIB
#include <algorithm>
#include <limits>
#include <memory>
#include <new>

#include <zlib.h>
#endif

namespace skelgen::io::detail {

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

#if SKELGEN_WITH_ZLIB

namespace {

constexpr int gzip_window = 15 + 16; // the largest, with gzip's header

/// zlib does not change its input, but its type says so only where a macro asks for it.
Bytef* input_bytes(std::string_view bytes) { return const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data())); }

/// The next part of the input: zlib counts by int.
std::string_view next_part(std::string_view bytes) {
    return bytes.substr(0, static_cast<std::size_t>(std::numeric_limits<int>::max()));
}

[[noreturn]] void refuse(const char* message) { throw Error(ErrorCode::bad_input, message); }

} // namespace

std::string gunzip(std::string_view bytes, std::size_t limit) {
    constexpr std::size_t best_ratio = 256, least = std::size_t{1} << 20U, chunk = std::size_t{1} << 18U;
    limit = std::min(limit, std::max(least, best_ratio * bytes.size()));
    ::z_stream stream{};
    if (::inflateInit2(&stream, gzip_window) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<::z_stream, int (*)(::z_stream*)> end(&stream, &::inflateEnd);

    std::string result;
    std::size_t used = 0;
    while (!bytes.empty()) {
        const std::string_view part = next_part(bytes);
        stream.next_in = input_bytes(part);
        stream.avail_in = static_cast<uInt>(part.size());
        if (used == result.size()) result.resize(std::max(2 * used, chunk));
        const std::size_t room = std::min(result.size() - used, chunk);
        stream.next_out = reinterpret_cast<Bytef*>(result.data() + used);
        stream.avail_out = static_cast<uInt>(room);
        const int status = ::inflate(&stream, Z_NO_FLUSH);
        bytes.remove_prefix(part.size() - stream.avail_in);
        used += room - stream.avail_out;
        if (used > limit)
            refuse("is far larger than any mesh when decompressed; decompress it yourself to see what it is");
        if (status == Z_STREAM_END) {
            result.resize(used);
            if (!is_gzip(bytes)) return result; // padding of tapes
            ::inflateReset(&stream);
        } else if (status != Z_OK) {
            refuse("is compressed by gzip and damaged; compress it again");
        }
    }
    refuse("is compressed by gzip and cut short; compress it again");
}

std::string gzip(std::string_view bytes) {
    ::z_stream stream{};
    constexpr int memory_level = 8; // zlib's default
    if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window, memory_level, Z_DEFAULT_STRATEGY) !=
        Z_OK)
        throw std::bad_alloc();
    const std::unique_ptr<::z_stream, int (*)(::z_stream*)> end(&stream, &::deflateEnd);
    std::string result(::deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
    std::size_t used = 0;
    int status = Z_OK;
    while (status != Z_STREAM_END) {
        const std::string_view part = next_part(bytes);
        stream.next_in = input_bytes(part);
        stream.avail_in = static_cast<uInt>(part.size());
        stream.next_out = reinterpret_cast<Bytef*>(result.data() + used);
        const std::string_view room = next_part(std::string_view(result).substr(used));
        stream.avail_out = static_cast<uInt>(room.size());
        status = ::deflate(&stream, part.size() == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        bytes.remove_prefix(part.size() - stream.avail_in);
        used += room.size() - stream.avail_out;
        if (status == Z_BUF_ERROR || status == Z_STREAM_ERROR)
            throw Error(ErrorCode::internal, "zlib cannot compress the mesh; report it");
    }
    result.resize(used);
    return result;
}

std::optional<std::string> zlib_compressed(std::string_view bytes) {
    auto size = ::compressBound(static_cast<uLong>(bytes.size()));
    std::string result(size, '\0');
    if (::compress(reinterpret_cast<Bytef*>(result.data()), &size, input_bytes(bytes),
                   static_cast<uLong>(bytes.size())) != Z_OK)
        throw std::bad_alloc();
    result.resize(size);
    return result;
}

#else

std::string gunzip(std::string_view, std::size_t) {
    throw Error(ErrorCode::bad_input,
                "is compressed by gzip, which this build of skelgen cannot read; build it with zlib "
                "(Debian: zlib1g-dev), or decompress the file first (gunzip)");
}

std::string gzip(std::string_view) {
    throw Error(ErrorCode::usage, "this build of skelgen cannot compress; build it with zlib (Debian: zlib1g-dev), or "
                                  "leave .gz out");
}

std::optional<std::string> zlib_compressed(std::string_view) { return std::nullopt; }

#endif

} // namespace skelgen::io::detail
