// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The exception for unusable input: what is wrong, where, and how to fix it. `main` turns it into one line
// and exit code 2. Expected failures (a frame that does not track, a bootstrap that is not ready) are values,
// never exceptions.
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// Unusable input or an output that cannot be written. what() reads "WHERE: WHAT; REMEDY" and has no line
/// break.
class InputError : public std::runtime_error {
 public:
  /// Joins the three parts into what(); `remedy` may be empty.
  InputError(const std::string& where, const std::string& what, const std::string& remedy)
      : std::runtime_error(where + ": " + what + (remedy.empty() ? "" : "; " + remedy)) {}
};

/// The candidate with the smallest edit distance to `word`; empty if `candidates` is empty. For "did you
/// mean".
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace edgevo
