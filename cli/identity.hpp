// Identity of the program: version and commit, as stored in results.
#pragma once

#include <string>

namespace pulvis {

std::string program_version();
std::string program_commit();  // and a hash of the sources

}  // namespace pulvis
