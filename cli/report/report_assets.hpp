// The parts of the report's page (cli/report/report/), embedded in the program at build time, so that
// it finds them wherever it is installed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pulvis {

std::string_view report_asset(std::string_view name);  // "page.html"; an unknown name throws

// Names of the parts that begin with this prefix, in order.
std::vector<std::string> report_assets_named(std::string_view beginning);

}  // namespace pulvis
