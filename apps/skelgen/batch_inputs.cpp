#include "batch_inputs.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fnmatch.h>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/io/mesh_format.hpp>

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

/// A mesh, and its path within the input that named it; or a folder, and why it cannot be searched.
struct FoundMesh {
    fs::path mesh;
    fs::path relative;
    std::string fault;
};

bool is_hidden(const fs::path& path) { return path.filename().native().front() == '.'; }

/// Adds all meshes below `folder`, in any order. `relative` is its path within the input.
void add_meshes_below(const fs::path& folder, const fs::path& relative, std::vector<FoundMesh>& found) {
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
        const fs::path& path = entry->path();
        if (is_hidden(path)) continue;
        std::error_code gone; // a file that vanishes meanwhile is no mesh
        if (entry->is_directory(gone) && !entry->is_symlink(gone))
            add_meshes_below(path, relative / path.filename(), found);
        else if (io::mesh_format_of(path) && entry->is_regular_file(gone))
            found.push_back({path, relative / path.filename(), {}});
    }
    if (error)
        found.push_back({folder, relative.empty() ? folder.filename() : relative,
                         "cannot be searched: " + error.message() + "; check the permissions"});
}

std::vector<FoundMesh> meshes_below(const fs::path& folder) {
    std::vector<FoundMesh> found;
    add_meshes_below(folder, {}, found);
    return found;
}

bool is_pattern(const std::string& text) { return text.find_first_of("*?[") != std::string::npos; }

using Parts = std::vector<std::string>;

Parts split(const fs::path& path) {
    Parts parts;
    for (const fs::path& part : path)
        if (!part.empty() && part != ".") parts.push_back(part.string());
    return parts;
}

/// Whether the folders and file name from `part` on match the pattern from `p` on. A pattern that is used up before the
/// path is named a folder above the file.
bool matches(Parts::const_iterator p, Parts::const_iterator pattern_end, Parts::const_iterator part,
             Parts::const_iterator path_end) {
    if (p == pattern_end) return true;
    if (*p == "**") {
        for (auto rest = part; rest != path_end; ++rest)
            if (matches(p + 1, pattern_end, rest, path_end)) return true;
        return false;
    }
    return part != path_end && ::fnmatch(p->c_str(), part->c_str(), FNM_PERIOD) == 0 &&
           matches(p + 1, pattern_end, part + 1, path_end);
}

std::vector<FoundMesh> meshes_matching(const std::string& text) {
    fs::path base;
    fs::path wild;
    for (const fs::path& part : fs::path(text)) {
        const bool fixed = wild.empty() && !is_pattern(part.string());
        (fixed ? base : wild) /= part;
    }
    const fs::path folder = base.empty() ? "." : base;
    std::error_code error;
    if (!fs::is_directory(folder, error)) return {};
    std::vector<FoundMesh> found = meshes_below(folder);
    const Parts pattern = split(wild);
    std::erase_if(found, [&](const FoundMesh& mesh) {
        const Parts path = split(mesh.relative);
        return !matches(pattern.begin(), pattern.end(), path.begin(), path.end());
    });
    return found;
}

std::vector<FoundMesh> find_meshes(const std::string& input) {
    std::error_code error;
    std::vector<FoundMesh> found;
    if (fs::is_directory(input, error))
        found = meshes_below(input);
    else if (is_pattern(input) && !fs::exists(input, error))
        found = meshes_matching(input);
    else if (input != "-" && !fs::exists(input, error) && !io::mesh_format_of(input)) // no mesh that is missing
        throw Error(ErrorCode::bad_input, input + ": there is no such folder or file; check the name");
    else
        found = {{input, fs::path(input).filename(), {}}};
    if (found.empty())
        throw Error(ErrorCode::bad_input,
                    input + ": holds no mesh (" + io::mesh_extensions_text() + "); check the name");
    return found;
}

bool is_same_file(const BatchItem& a, const BatchItem& b) {
    std::error_code error;
    return a.mesh == b.mesh || fs::equivalent(a.mesh, b.mesh, error);
}

/// Orders the items by `file` and drops those named twice.
std::vector<BatchItem> distinct(std::vector<BatchItem> items) {
    std::stable_sort(items.begin(), items.end(),
                     [](const BatchItem& a, const BatchItem& b) { return a.file < b.file; });
    std::vector<BatchItem> out;
    for (BatchItem& item : items) {
        if (out.empty() || out.back().file != item.file)
            out.push_back(std::move(item));
        else if (!is_same_file(out.back(), item))
            throw Error(ErrorCode::usage, item.output.string() + ": both " + out.back().mesh.string() + " and " +
                                              item.mesh.string() +
                                              " would be written there; rename one, or run them into two folders");
    }
    return out;
}

/// Meshes that differ in their extension alone keep it in their outputs' names.
std::vector<BatchItem> with_outputs_apart(std::vector<BatchItem> items) {
    std::map<fs::path, int> count;
    for (const BatchItem& item : items) ++count[item.output];
    for (BatchItem& item : items)
        if (count[item.output] > 1) item.output.replace_extension(item.mesh.extension().string() + ".json");
    return items;
}

} // namespace

std::vector<BatchItem> find_batch_items(const std::vector<std::string>& inputs, const fs::path& output_folder) {
    std::vector<BatchItem> items;
    for (const std::string& input : inputs)
        for (const FoundMesh& found : find_meshes(input)) {
            fs::path output = io::without_extensions(output_folder / found.relative);
            items.push_back({found.mesh, printable(found.relative), output += ".json", found.fault, output_folder});
        }
    return with_outputs_apart(distinct(std::move(items)));
}

std::string printable(const fs::path& path) {
    std::string text;
    for (const char c : path.generic_string()) text += c == '\\' ? std::string("\\\\") : std::string(1, c);
    try {
        static_cast<void>(nlohmann::json(text).dump());
        return text;
    } catch (const nlohmann::json::type_error&) { // no UTF-8
    }
    std::string ascii;
    for (const char c : text) {
        char digits[5];
        std::snprintf(digits, sizeof digits, "\\x%02x", static_cast<unsigned char>(c));
        ascii += static_cast<unsigned char>(c) < 0x80 ? std::string(1, c) : std::string(digits);
    }
    return ascii;
}

Shard parse_shard(const std::string& text) {
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, shard.number);
    const bool has_slash = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
    const auto count = std::from_chars(has_slash ? number.ptr + 1 : end, end, shard.count);
    const bool is_complete = has_slash && count.ec == std::errc() && count.ptr == end;
    if (!is_complete || shard.number < 1 || shard.number > shard.count)
        throw Error(ErrorCode::usage, "--shard " + text + ": is not K/N with K from 1 to N, such as 2/4");
    return shard;
}

std::vector<BatchItem> take_shard(const std::vector<BatchItem>& items, const Shard& shard) {
    std::vector<BatchItem> part;
    for (std::size_t i = shard.number - 1; i < items.size(); i += shard.count) part.push_back(items[i]);
    return part;
}

} // namespace skelgen::cli
