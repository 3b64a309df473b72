#include "fitted_inputs.hpp"

#include <cstddef>
#include <map>

#include <skelgen/io/mesh_format.hpp>
#include <skelgen/surface/prepare.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "progress_bar.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

FittedInput fit(const BatchItem& item, const FittedInputs& inputs) {
    const WaitingLine waiting(item.mesh.string(), !inputs.quiet);
    if (!item.fault.empty()) throw Error(ErrorCode::bad_input, item.fault);
    ExtractOptions options;
    options.prepare.component = item.component;
    MeshInput mesh{item.mesh};
    mesh.skeleton = inputs.skeleton;
    mesh.wanted = inputs.wanted;
    return {fit_file(mesh, options), item};
}

/// How many bodies stand apart in a mesh; 1 where it is none, which is said when it is looked for them.
int count_bodies(const BatchItem& item) {
    try {
        return item.fault.empty() ? surface::gather(load_mesh({item.mesh})).bodies : 1;
    } catch (const Error&) {
        return 1;
    }
}

/// Each of several bodies in a mesh.
std::vector<BatchItem> bodies_in(const BatchItem& item) {
    const int count = count_bodies(item);
    if (count == 1) return {item};
    std::vector<BatchItem> out(static_cast<std::size_t>(count), item);
    for (int number = 1; number <= count; ++number) {
        BatchItem& body = out[static_cast<std::size_t>(number) - 1];
        const std::string suffix = '.' + std::to_string(number);
        body.component = number;
        body.file += suffix;
        body.output.replace_extension(suffix + ".json");
    }
    return out;
}

/// What messages call it.
std::filesystem::path name_of(const BatchItem& item, const FittedInputs& inputs) {
    if (inputs.component != all_components || item.component == 0) return item.mesh;
    return item.mesh.string() + ": body " + std::to_string(item.component);
}

} // namespace

void add_fitted_inputs(CLI::App& command, FittedInputs& inputs) {
    command
        .add_option("MESH", inputs.inputs,
                    "Meshes of one body each (" + io::mesh_extensions_text() +
                        ", also .gz of each), folders of meshes, patterns; - for standard input")
        ->required();
    add_wanted_option(command, inputs.wanted);
    add_skeleton_option(command, inputs.skeleton);
    add_components_option(command, inputs.component);
    command.add_flag("-q,--quiet", inputs.quiet, "No warnings but that a skeleton is a guess");
}

bool are_many(const FittedInputs& inputs, const std::vector<BatchItem>& items) {
    return items.size() > 1 || std::filesystem::is_directory(inputs.inputs.front());
}

std::vector<BatchItem> find_items(const FittedInputs& inputs, const std::filesystem::path& folder) {
    std::vector<BatchItem> items = find_batch_items(inputs.inputs, folder);
    if (inputs.component != all_components) {
        for (BatchItem& item : items) item.component = inputs.component;
        return items;
    }
    std::vector<BatchItem> bodies;
    std::map<std::filesystem::path, std::filesystem::path> meshes; // by output
    for (const BatchItem& item : items)
        for (const BatchItem& body : bodies_in(item)) {
            const auto [other, is_new] = meshes.emplace(body.output, body.mesh);
            if (!is_new)
                throw Error(ErrorCode::usage, body.output.string() + ": both " + other->second.string() + " and " +
                                                  body.mesh.string() + " would be written there; rename one");
            bodies.push_back(body);
        }
    return bodies;
}

void for_each_fitted(const FittedInputs& inputs, const std::vector<BatchItem>& items,
                     const std::function<void(const FittedInput&)>& work) {
    if (!inputs.skeleton.empty() && are_many(inputs, items))
        throw Error(ErrorCode::usage, "--skeleton: is of one mesh, and there are several; give one alone");
    std::size_t done = 0, failed = 0;
    ProgressBar bar(items.size(), !inputs.quiet && items.size() > 1, patience_seconds);
    for (const BatchItem& item : items) {
        try {
            const FittedInput input = in_file(name_of(item, inputs), [&] { return fit(item, inputs); });
            work(input);
            print_warnings(name_of(item, inputs), input.skeleton(), input.found.body.repairs, words_of(inputs.quiet));
        } catch (const Error& error) {
            // What cannot be stored for one cannot be stored for the others either.
            if (!are_many(inputs, items) || error.code() == ErrorCode::not_written) throw;
            print_error(error.what());
            ++failed;
        }
        bar.show(++done, failed);
    }
    if (failed > 0) throw CLI::RuntimeError(status_some_failed);
}

} // namespace skelgen::cli
