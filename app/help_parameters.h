// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Output of `edgevo help parameters`.
#include <string>

namespace edgevo::app {

/// Handles `edgevo help parameters [--all]`: prints to standard output and returns true; returns false for
/// any other command line. Throws InputError for an unknown word after `parameters`.
bool print_parameters_help(int argc, const char* const* argv);

/// Writes both texts into `folder`, where front_main.cpp finds them: help_file_name("parameters") and
/// help_file_name("parameters-all").
void write_parameters_help(const std::string& folder);

}  // namespace edgevo::app
