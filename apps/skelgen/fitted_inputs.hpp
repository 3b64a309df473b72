#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "batch_inputs.hpp"
#include "fitted_file.hpp"

namespace skelgen::cli {

/// The meshes of a command that takes several, each of one body.
struct FittedInputs {
    std::vector<std::string> inputs; ///< as `find_batch_items` takes them
    bool quiet = false;              ///< no warnings
    std::filesystem::path skeleton;  ///< of a single mesh; empty: it is to be found
    int component = 0;               ///< as `PrepareOptions::component`, or `all_components`
    std::string wanted = "human21";  ///< as `MeshInput::wanted`
};

/// Adds the positional MESH..., --template, --skeleton, --component and the flag --quiet.
void add_fitted_inputs(CLI::App& command, FittedInputs& inputs);

/// One of them.
struct FittedInput : FittedFile {
    BatchItem item; ///< `item.output` lies in the folder that the command writes to
};

/// Are these several meshes, or a folder of them, so that results go to a folder?
[[nodiscard]] bool are_many(const FittedInputs& inputs, const std::vector<BatchItem>& items);

/// The meshes in `inputs`, their outputs in `folder`; where all bodies are wanted, each of those in a mesh of several.
/// \throws Error as `find_batch_items`.
[[nodiscard]] std::vector<BatchItem> find_items(const FittedInputs& inputs, const std::filesystem::path& folder);

/// Finds the skeleton in each mesh and does `work` with it. Of one mesh a failure is the command's own; of many each
/// costs that mesh alone: it is printed, and the command ends with status 5 after the last.
/// \throws Error with the file's name in front; CLI::RuntimeError where some of many failed.
void for_each_fitted(const FittedInputs& inputs, const std::vector<BatchItem>& items,
                     const std::function<void(const FittedInput&)>& work);

} // namespace skelgen::cli
