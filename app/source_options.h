#pragma once
// The options by which every command that reads images names its source.
#include <CLI/CLI.hpp>

#include "edgevo/datasets/open_source.h"

namespace edgevo::app {

/// Adds SOURCE, --camera, --sensor, --frames, --every and --fps to `command`; they fill `*options` while it
/// parses. A wrong --frames is an InputError.
void add_source_options(CLI::App& command, SourceOptions* options);

}  // namespace edgevo::app
