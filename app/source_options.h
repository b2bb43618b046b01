// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Source options, common to all commands that read images.
#include <CLI/CLI.hpp>

#include <memory>

#include "edgevo/core/target_pinhole.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo::app {

/// Adds SOURCE, --camera, --fov, --sensor, --topic, --frames, --every and --fps to `command`; parsing fills
/// `*options` and throws InputError for a wrong --frames.
void add_source_options(CLI::App& command, SourceOptions* options);

/// Adds --mount.
void add_mount(CLI::App& command, std::optional<CameraMount>* mount);

/// Adds --image-scale; its default, auto, depends on the size of the images.
void add_image_scale(CLI::App& command, SourceOptions* options);

/// Adds --rectify-fov and --rectify-size.
void add_rectification(CLI::App& command, TargetRequest* request);

/// Prints to stderr.
void print_lines(const std::vector<std::string>& lines);

/// Prints what was decided about the input at `path` to stderr, one line each, and the doubts as warnings.
void print_decisions(const std::string& path, const std::vector<InputDecision>& decisions);

/// Calls open_source() and prints the notices to stderr, one line each.
std::unique_ptr<ImageSource> open_source_with_notices(const SourceOptions& options);

}  // namespace edgevo::app
