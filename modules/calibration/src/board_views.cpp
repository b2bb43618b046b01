// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/board_views.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr float kAlike = 0.02f;  // of the image's width
// The error falls with the square root of their number, the time grows with its cube.
constexpr size_t kMaxViews = 60;

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
  if (views.size() <= kMaxViews) return views;
  std::vector<BoardView> kept;
  for (size_t i = 0; i < kMaxViews; ++i) kept.push_back(std::move(views[i * views.size() / kMaxViews]));
  return kept;
}

// What was found in the images of one size.
struct OfOneSize {
  BoardViews views;
  std::vector<std::string> names;
};
// In the order in which they appear.
using BySize = std::vector<OfOneSize>;

std::string size_text(const BoardViews& views) {
  return std::to_string(views.width) + "x" + std::to_string(views.height);
}

OfOneSize& with_size_of(const GrayImage& image, BySize* sizes) {
  for (OfOneSize& size : *sizes)
    if (size.views.width == image.width && size.views.height == image.height) return size;
  sizes->emplace_back();
  sizes->back().views.width = image.width;
  sizes->back().views.height = image.height;
  return sizes->back();
}

std::string name_of(const Frame& frame) {
  return frame.image_path.empty() ? "image " + std::to_string(frame.index)
                                  : std::filesystem::path(frame.image_path).filename().string();
}

void search(const Frame& frame, const BoardFinder& finder, BySize* sizes) {
  auto& [all, names] = with_size_of(frame.image, sizes);
  names.push_back(name_of(frame));
  ++all.images;
  std::optional<BoardView> view = finder.find(frame.image);
  if (!view) return;
  ++all.seen;
  view->frame = frame.index;
  if (is_new(*view, all)) all.views.push_back(std::move(*view));
}

[[noreturn]] void refuse_without_majority(const BySize& sizes) {
  std::string list;
  for (const OfOneSize& size : sizes)
    list += (list.empty() ? "" : ", ") + std::to_string(size.views.images) + " of " + size_text(size.views);
  throw InputError("the images", "have several sizes, none that of most: " + list,
                   "give those of one camera in one size");
}

// The views of the size that most images have; the others are named.
BoardViews most_common(BySize sizes) {
  const auto most = std::max_element(sizes.begin(), sizes.end(), [](const OfOneSize& a, const OfOneSize& b) {
    return a.views.images < b.views.images;
  });
  if (most == sizes.end()) return {};
  BoardViews kept = std::move(most->views);
  int all = kept.images;
  for (auto size = sizes.begin(); size != sizes.end(); ++size) {
    if (size == most) continue;
    all += size->views.images;
    for (const std::string& name : size->names)
      kept.of_other_size.push_back(name + " (" + size_text(size->views) + ")");
  }
  most->views = kept;  // for the message
  if (2 * kept.images <= all) refuse_without_majority(sizes);
  return kept;
}

}  // namespace

BoardViews collect_views(ImageSource& source, const BoardFinder& finder,
                         const std::function<bool()>& on_image) {
  BySize sizes;
  bool go_on = true;
  while (go_on) {
    const std::optional<Frame> frame = source.next();
    if (!frame) break;
    search(*frame, finder, &sizes);
    go_on = on_image();
  }
  BoardViews all = most_common(std::move(sizes));
  all.views = thinned(std::move(all.views));
  return all;
}

}  // namespace edgevo
