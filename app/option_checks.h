#pragma once
// Checks of option values that say in words what is wanted, and a parse error as one line with a remedy.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <string>

namespace edgevo::app {

/// "must be a whole number from LEAST to MOST".
CLI::Validator whole_number(uint64_t least, uint64_t most = std::numeric_limits<int>::max());
/// "must be a number larger than 0".
CLI::Validator positive_number();
/// "must be a number, 0 or larger".
CLI::Validator number_from_zero();
/// "must be a number from LEAST to MOST".
CLI::Validator number_between(double least, double most);
/// "names no folder": an empty word, as an unset variable of a script leaves it.
CLI::Validator path_given();

/// --force: what is there already may be written over.
void add_force(CLI::App& command, bool* force);

/// What was wrong with the command line, with the nearest name for a misspelt command or option.
std::string explain(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv);

}  // namespace edgevo::app
