#pragma once
// The options by which every command that reads images names its source.
#include <CLI/CLI.hpp>

#include <memory>

#include "edgevo/datasets/open_source.h"

namespace edgevo::app {

/// Adds SOURCE, --camera, --fov, --sensor, --frames, --every and --fps to `command`; they fill `*options`
/// while it parses. A wrong --frames is an InputError.
void add_source_options(CLI::App& command, SourceOptions* options);

/// Adds --image-scale; without it the scale is the usual one for the images' width.
void add_image_scale(CLI::App& command, SourceOptions* options);

/// How the camera was guessed and whether images were scaled: what a user must be told of a source, as name
/// and value.
std::vector<std::pair<std::string, std::string>> to_be_told(const ImageSource& source);

/// open_source(), and on stderr a line for each of these.
std::unique_ptr<ImageSource> open_and_tell(const SourceOptions& options);

}  // namespace edgevo::app
