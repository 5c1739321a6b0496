// Which program this is: version and commit, as results carry them.
#pragma once

#include <string>

namespace pulvis {

std::string program_version();
std::string program_commit();  // and a hash of the sources

}  // namespace pulvis
