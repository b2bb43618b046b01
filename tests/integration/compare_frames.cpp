// SPDX-License-Identifier: BSD-3-Clause
// compare_frames SOURCE REFERENCE: whether two sources give the same camera and frames: times and pixels, to
// the byte. Prints the number of frames; exit code 1 at the first difference.
#include <cstdio>

#include "edgevo/core/error.h"
#include "edgevo/datasets/open_source.h"

namespace {

using namespace edgevo;

int differ(const std::string& what, int frames) {
  std::fprintf(stderr, "%s differs after %d equal frames\n", what.c_str(), frames);
  return 1;
}

int compare(const std::string& path, const std::string& reference_path) {
  const auto source = open_source(path), reference = open_source(reference_path);
  if (!(source->camera().pinhole() == reference->camera().pinhole()) ||
      coefficients_of(source->camera().model) != coefficients_of(reference->camera().model))
    return differ("the camera", 0);
  for (int frames = 0;; ++frames) {
    const auto frame = source->next(), expected = reference->next();
    if (frame.has_value() != expected.has_value()) return differ("the number of frames", frames);
    if (!frame) return std::printf("%d\n", frames) < 0;
    if (frame->time.ticks != expected->time.ticks) return differ("the time", frames);
    if (frame->image.width != expected->image.width) return differ("the size", frames);
    if (frame->image.pixels != expected->image.pixels || frame->image.values != expected->image.values)
      return differ("the image", frames);
  }
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 3) throw InputError(arguments[0], "needs SOURCE REFERENCE", "");
  return compare(arguments[1], arguments[2]);
} catch (const InputError& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}
