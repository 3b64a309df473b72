#include "core_backwards.hpp"

std::size_t joints_seen_by_the_other_file();

std::size_t joints_seen_by_the_other_file() { return skelgen::builtin_template("human21").joints.size(); }
