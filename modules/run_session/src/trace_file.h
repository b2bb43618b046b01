// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>

#include "edgevo/core/output_file.h"

namespace edgevo {

/// The file of --trace.
class TraceFile {
 public:
  /// Opens the file and begins the trace; does nothing without a path. Throws InputError.
  explicit TraceFile(const std::string& path);
  /// Writes the trace of a run that an exception ends; a failure is said.
  ~TraceFile();
  /// Ends the trace and writes it. Throws InputError.
  void close();

 private:
  std::optional<OutputFile> file_;
};

}  // namespace edgevo
