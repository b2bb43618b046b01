// SPDX-License-Identifier: BSD-3-Clause
// make_outputs OUT: writes the outputs of a synthetic run, for stock_tools.sh.
#include <cstdio>

#include "edgevo/core/error.h"
#include "edgevo/results/run_outputs.h"
#include "support/synthetic_run.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_outputs OUT\n");
    return 2;
  }
  try {
    const auto made = edgevo::test::synthetic_run();
    edgevo::RunOutputs outputs(argv[1], made.camera, {});
    for (const auto& frame : made.run.frames)
      if (!outputs.add_frame(edgevo::test::synthetic_frame(made.camera, frame))) break;
    edgevo::RunInfo info;
    info.command_line = {"make_outputs", argv[1]};
    info.camera = made.camera;
    outputs.finish(made.run, info);
  } catch (const edgevo::InputError& e) {
    std::fprintf(stderr, "make_outputs: %s\n", e.what());
    return 2;
  }
}
