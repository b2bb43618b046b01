// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/board_views.h"

#include <algorithm>
#include <limits>

namespace edgevo {
namespace {

constexpr float kAlike = 0.02f;  // of the image's width
// The error falls with the square root of their number, the time grows with its cube.
constexpr size_t kMostViews = 60;

// Mean distance between the corners common to both; infinite if there are none.
float distance(const BoardView& a, const BoardView& b) {
  float sum = 0;
  int common = 0;
  for (size_t i = 0, j = 0; i < a.ids.size() && j < b.ids.size();) {
    if (a.ids[i] == b.ids[j]) {
      sum += (a.px[i++] - b.px[j++]).norm();
      ++common;
    } else {
      a.ids[i] < b.ids[j] ? ++i : ++j;
    }
  }
  return common ? sum / float(common) : std::numeric_limits<float>::infinity();
}

bool is_new(const BoardView& view, const BoardViews& all) {
  return std::none_of(all.views.begin(), all.views.end(), [&](const BoardView& kept) {
    return distance(kept, view) < kAlike * float(all.width);
  });
}

std::vector<BoardView> thinned(std::vector<BoardView> views) {
  if (views.size() <= kMostViews) return views;
  std::vector<BoardView> kept;
  for (size_t i = 0; i < kMostViews; ++i) kept.push_back(std::move(views[i * views.size() / kMostViews]));
  return kept;
}

}  // namespace

BoardViews collect_views(ImageSource& source, const BoardFinder& finder,
                         const std::function<bool()>& on_image) {
  BoardViews all;
  bool go_on = true;
  while (go_on) {
    const std::optional<Frame> frame = source.next();
    if (!frame) break;
    all.width = frame->image.width;
    all.height = frame->image.height;
    ++all.images;
    if (std::optional<BoardView> view = finder.find(frame->image)) {
      ++all.seen;
      view->frame = frame->index;
      if (is_new(*view, all)) all.views.push_back(std::move(*view));
    }
    go_on = on_image();
  }
  all.views = thinned(std::move(all.views));
  return all;
}

}  // namespace edgevo
