// The options of `pulvis preview`.
#pragma once

#include "cli/options.hpp"
#include "cli/preview/preview.hpp"

namespace pulvis {

void add_preview(CLI::App& app, PreviewOptions& options, ExitCode& code);

}  // namespace pulvis
