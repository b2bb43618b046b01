// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Services of the program that writes a sequence.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// Shows the number of frames done; the display ends when the last copy is destroyed.
using ShowFramesDone = std::function<void(int done)>;

/// Services of the calling program.
struct SequenceHost {
  /// Opens a source and says what it was taken for.
  std::function<std::unique_ptr<ImageSource>(const SourceOptions& options)> open;
  /// Starts a progress display: its title, and the number of frames if known.
  std::function<ShowFramesDone(const std::string& what, std::optional<int> total)> progress;
  /// Prints a line about what was written.
  std::function<void(const std::string& line)> print;
};

}  // namespace edgevo
