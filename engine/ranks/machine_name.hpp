// The machine this process runs on.
#pragma once

#include <string>

namespace pulvis {

std::string host_name();
// Distinguishes machines: the kernel's boot ID, which containers on one machine share, or the host name.
std::string machine_name();

}  // namespace pulvis
