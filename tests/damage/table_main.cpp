// skelgen-damage-table TRUTH FOLDER [--failed]: how the skeletons of damaged bodies compare with those of sound ones.

#include <exception>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

#include "table.hpp"

int main(int argc, char** argv) {
    std::string truth, folder;
    bool failed = false;
    CLI::App app("Scores the skeletons of damaged bodies.", "skelgen-damage-table");
    app.add_option("TRUTH", truth, "Folder of true joints: <name>.json")->required();
    app.add_option("FOLDER", folder, "What ./dev damage has written: clean/ and skeletons/")->required();
    app.add_flag("--failed", failed, "Name the meshes that are not solved");
    CLI11_PARSE(app, argc, argv);
    try {
        const auto rows = skelgen::damage::score(truth, folder);
        std::cout << to_table(rows);
        if (failed)
            for (const auto& row : rows)
                for (const std::string& line : row.failed) std::cout << line << '\n';
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "skelgen-damage-table: error: " << error.what() << '\n';
        return 1;
    }
}
