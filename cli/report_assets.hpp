// The parts of the report's page (cli/report/), put into the program when it is built: the program
// finds them wherever it is installed.
#pragma once

#include <string_view>

namespace pulvis {

std::string_view report_asset(std::string_view name);  // "page.html"; an unknown name throws

}  // namespace pulvis
