#include "fitted_inputs.hpp"

#include <cstddef>

#include <skelgen/io/mesh_format.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "progress_bar.hpp"
#include "waiting_line.hpp"

namespace skelgen::cli {
namespace {

FittedInput fit(const BatchItem& item, const FittedInputs& inputs) {
    const WaitingLine waiting(item.mesh.string(), !inputs.quiet);
    if (!item.fault.empty()) throw Error(ErrorCode::bad_input, item.fault);
    return {fit_file({item.mesh, {}, inputs.skeleton}), item};
}

} // namespace

void add_fitted_inputs(CLI::App& command, FittedInputs& inputs) {
    command
        .add_option("MESH", inputs.inputs,
                    "Meshes of one body each (" + io::mesh_extensions_text() +
                        ", also .gz of each), folders of meshes, patterns; - for standard input")
        ->required();
    add_skeleton_option(command, inputs.skeleton);
    command.add_flag("-q,--quiet", inputs.quiet, "No warnings but that a skeleton is a guess");
}

bool are_many(const FittedInputs& inputs, const std::vector<BatchItem>& items) {
    return items.size() > 1 || std::filesystem::is_directory(inputs.inputs.front());
}

std::vector<BatchItem> find_items(const FittedInputs& inputs, const std::filesystem::path& folder) {
    return find_batch_items(inputs.inputs, folder);
}

void for_each_fitted(const FittedInputs& inputs, const std::vector<BatchItem>& items,
                     const std::function<void(const FittedInput&)>& work) {
    if (!inputs.skeleton.empty() && are_many(inputs, items))
        throw Error(ErrorCode::usage, "--skeleton: is of one mesh, and there are several; give one alone");
    std::size_t done = 0, failed = 0;
    ProgressBar bar(items.size(), !inputs.quiet && items.size() > 1, patience_seconds);
    for (const BatchItem& item : items) {
        try {
            const FittedInput input = in_file(item.mesh, [&] { return fit(item, inputs); });
            work(input);
            print_warnings(item.mesh, input.skeleton(), input.found.body.repairs, words_of(inputs.quiet));
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
