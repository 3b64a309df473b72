// With link_2.cpp: the whole core, header-only, in two translation units of one program. A function that should be
// inline and is not gives a link error.

#include "core_forwards.hpp"

std::size_t joints_seen_by_the_other_file();

int main() { return skelgen::builtin_template("human21").joints.size() == joints_seen_by_the_other_file() ? 0 : 1; }
