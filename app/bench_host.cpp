// SPDX-License-Identifier: BSD-3-Clause
#include "bench_host.h"

#include <memory>

#include "progress.h"
#include "signals.h"
#include "source_options.h"
#include "version.h"

namespace edgevo::app {

BenchHost bench_host() {
  BenchHost host;
  host.version = version();
  host.listen_to_signals = listen_to_signals;
  host.stop = interrupted;
  host.progress = [](const std::string& what, std::optional<int> total) -> ProgressLine {
    return [line = std::make_shared<Progress>(what, total)](int done) { line->update(done); };
  };
  host.show_input = print_decisions;
  return host;
}

}  // namespace edgevo::app
