// SPDX-License-Identifier: BSD-3-Clause
#include "rendered_sequences.h"

#include <algorithm>

#include "edgevo/simulation/rendered_source.h"
#include "run_figures.h"

namespace edgevo::test {

RenderedSequence render_sequence(const Scene& scene, int begin, int end) {
  const auto renderer = std::make_shared<SceneRenderer>(scene);
  RenderedSource source(renderer, begin, end);
  return {read_clip(source, [](int) { return true; }), truth_of(renderer->scene(), begin, end)};
}

RenderedSequence part_of(const RenderedSequence& sequence, int begin, int end) {
  auto clip = std::make_shared<Clip>(Clip{sequence.clip->camera, sequence.clip->kind, {}});
  clip->frames.assign(sequence.clip->frames.begin() + begin, sequence.clip->frames.begin() + end);
  Trajectory truth;
  truth.path = sequence.truth.path;
  truth.poses.assign(sequence.truth.poses.begin() + begin, sequence.truth.poses.begin() + end);
  return {clip, truth};
}

RenderedSequence backward(const RenderedSequence& sequence) {
  RenderedSequence mirrored{played_backward(*sequence.clip), sequence.truth};
  std::reverse(mirrored.truth.poses.begin(), mirrored.truth.poses.end());
  for (size_t i = 0; i < mirrored.truth.poses.size(); ++i)
    mirrored.truth.poses[i].time = mirrored.clip->frames[i].time;
  return mirrored;
}

const RenderedSequence& street_sequence() {
  static const RenderedSequence sequence = render_sequence(load_scene("street"), 0, 130);
  return sequence;
}

const RenderedSequence& desk_sequence() {
  static const RenderedSequence sequence = render_sequence(load_scene("desk"), 0, 100);
  return sequence;
}

const RenderedSequence& corridor_sequence() {
  static const RenderedSequence sequence = render_sequence(load_scene("corridor"), 0, 200);
  return sequence;
}

}  // namespace edgevo::test
