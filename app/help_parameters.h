#pragma once
// What `edgevo help parameters` prints.
#include <string>
#include <vector>

#include "edgevo/core/params.h"

namespace edgevo::app {

/// The basic parameters, each with its default, its range and what it is; with `all` the advanced and the
/// experimental ones too, level by level.
std::string parameters_text(const std::vector<ParamDescription>& params, bool all);

/// Answers `edgevo help parameters [--all]` on standard output. False: the command line asks for something
/// else. Throws InputError for another word behind `parameters`.
bool print_parameters_help(int argc, const char* const* argv);

}  // namespace edgevo::app
