// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The output folder of a run and its only owner: makes the folder, resolves paths in it, and records which
// files could not be written. A file that fails does not keep the others from being written: failures are
// collected, and the first is thrown at the end.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/error.h"

namespace edgevo {

/// The folder of one run.
class RunFolder {
 public:
  /// Makes the folder and its parents. Throws InputError: a file is in the way, or the folder cannot be made.
  explicit RunFolder(std::string path);

  /// Path of the folder, as given.
  const std::string& path() const { return path_; }
  /// Path of `file` within the folder, whether it exists or not.
  std::string path_of(const std::string& file) const;

  /// Calls `write` with the path of `file`; whatever it throws is recorded as a failure.
  void attempt(const std::string& file, const std::function<void(const std::string& path)>& write);
  /// Records the failure of a file that was not written through attempt().
  void note_failure(const std::string& file, const InputError& error);

  /// Names of the files that could not be written so far.
  const std::vector<std::string>& not_written() const { return not_written_; }
  /// Throws the first failure (InputError), if there was one.
  void throw_first_failure() const;

 private:
  std::string path_;
  std::optional<InputError> first_failure_;
  std::vector<std::string> not_written_;
};

}  // namespace edgevo
