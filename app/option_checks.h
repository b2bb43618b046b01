// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Validators of option values with readable messages, and parse errors as one line with a remedy.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <string>

#include "edgevo/core/params.h"

namespace edgevo::app {

/// Accepts a whole number from `least` to `most`.
CLI::Validator whole_number(uint64_t least, uint64_t most = std::numeric_limits<int>::max());
/// Accepts a finite number larger than 0.
CLI::Validator positive_number();
/// Accepts a finite number, 0 or larger.
CLI::Validator number_from_zero();
/// Accepts a number from `least` to `most`.
CLI::Validator number_between(double least, double most);
/// Refuses an empty path, as an unset variable in a script gives.
CLI::Validator path_given();

/// Reads a file of parameters; says so if it is the block of a summary.yaml, unless `quiet`.
void read_params_given(const std::string& path, const VisitParams& visit, bool quiet = false);

/// Adds --force, which allows overwriting existing files.
void add_force(CLI::App& command, bool* force);
/// Adds --include-doubtful.
void add_include_doubtful(CLI::App& command, bool* include);

/// One-line message for a parse error, with the nearest name for a misspelt command or option.
std::string explain(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv);

}  // namespace edgevo::app
