#include "fingerprint.hpp"

#include <cstdint>
#include <cstdio>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>
#include <skelgen/io/template_json.hpp>
#include <skelgen/version.hpp>

namespace skelgen::cli {

std::string fingerprint(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
    return digits;
}

std::string input_fingerprint(const std::filesystem::path& mesh, const SkeletonTemplate& skeleton_template) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(mesh, error)) return {}; // a pipe can be read once only
    try {
        return fingerprint(fingerprint(io::read_file(mesh)) + io::template_to_json(skeleton_template) +
                           std::string(version));
    } catch (const Error&) {
        return {};
    }
}

std::string result_fingerprint(const KinematicSkeleton<double>& skeleton, const std::optional<io::SourceMesh>& mesh) {
    return fingerprint(skeleton_to_json(skeleton, {mesh, std::nullopt}));
}

std::string result_fingerprint(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return {};
    try {
        const io::SkeletonDocument document = io::read_skeleton_document(file);
        return result_fingerprint(document.skeleton, document.provenance.mesh);
    } catch (const Error&) {
        return {};
    }
}

} // namespace skelgen::cli
