#include "program.hpp"

int main(int argc, char** argv) { return skelgen::cli::run_program(argc, argv); }
