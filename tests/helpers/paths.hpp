// Where the tests find the sources and the built program. Only paths.cpp is compiled anew for another folder.
#pragma once

#include <string>

namespace pulvis::paths {

std::string source_dir();  // the root of the source tree
std::string program();     // the program `pulvis`
std::string libraries();   // of the core library, with one folder an instruction set below it

}  // namespace pulvis::paths
