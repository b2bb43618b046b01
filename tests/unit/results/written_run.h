// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fixture with a synthetic run and the folder that it is written to.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "edgevo/core/error.h"
#include "edgevo/results/run_outputs.h"
#include "support/synthetic_run.h"
#include "support/temp_folder.h"
#include "support/text.h"

namespace edgevo {

class WrittenRun : public ::testing::Test {
 protected:
  static void write(const std::filesystem::path& folder, const edgevo::Run& run, const Camera& camera) {
    RunOutputs outputs(folder.string(), camera, {});
    for (const FrameRecord& frame : run.frames)
      if (!outputs.add_frame(test::synthetic_frame(camera, frame))) break;
    RunInfo info;
    info.command_line = {"edgevo", "run", "a \"quoted\" folder"};
    info.source_kind = "synthetic";
    info.camera = camera;
    info.params_yaml = "edges:\n  percentile: 0.9\nseed: 3\n";
    info.notes = {{"bootstrap", "took 4 frames: not enough parallax"}};
    outputs.finish(run, info);
  }
  static std::string message_of(const std::function<void()>& work) {
    try {
      work();
    } catch (const InputError& e) {
      return e.what();
    }
    return "no InputError";
  }

  test::TempFolder temp_;
  const std::filesystem::path folder_ = temp_ / "out";  // not there yet
  const test::SyntheticRun made_ = test::synthetic_run();
};

}  // namespace edgevo
