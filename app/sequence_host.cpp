// SPDX-License-Identifier: BSD-3-Clause
#include "sequence_host.h"

#include <cstdio>
#include <memory>

#include "progress.h"
#include "source_options.h"

namespace edgevo::app {

SequenceHost sequence_host() {
  SequenceHost host;
  host.open = open_source_with_notices;
  host.progress = [](const std::string& what, std::optional<int> total) -> ShowFramesDone {
    return [line = std::make_shared<Progress>(what, total)](int done) { line->update(done); };
  };
  host.print = [](const std::string& line) { std::printf("%s\n", line.c_str()); };
  return host;
}

}  // namespace edgevo::app
