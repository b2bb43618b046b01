// SPDX-License-Identifier: BSD-3-Clause
// edgevo_training_set OUT [train|lasting|test] [SEED] [FRAMES]: writes pieces of rendered frames with their
// edges to one file. train: the training worlds in random light with true edges; lasting: the same with the
// edges that a run found again; test: the held-out worlds in each light in turn.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "edgevo/core/error.h"
#include "training_set.h"

int main(int argc, char** argv) try {
  if (argc < 2)
    throw edgevo::InputError("edgevo_training_set", "no output file is given",
                             "write edgevo_training_set OUT [train|lasting|test] [SEED] [FRAMES]");
  edgevo::training::Plan plan = edgevo::training::plan_named(argc > 2 ? argv[2] : "train");
  if (argc > 3) plan.seed = std::strtoull(argv[3], nullptr, 10);
  if (argc > 4) plan.frames = std::max(1, std::atoi(argv[4]));
  const auto samples = edgevo::training::make_samples(plan);
  edgevo::training::write_samples(argv[1], samples);
  std::printf("%s: %zu pieces\n", argv[1], samples.size());
  return 0;
} catch (const edgevo::InputError& e) {
  std::fprintf(stderr, "edgevo_training_set: %s\n", e.what());
  return 2;
}
