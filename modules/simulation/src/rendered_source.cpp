// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/rendered_source.h"

#include "edgevo/core/error.h"

namespace edgevo {

RenderedSource::RenderedSource(std::shared_ptr<const SceneRenderer> renderer, int begin, int end)
    : renderer_(std::move(renderer)), begin_(begin), end_(end < 0 ? renderer_->size() : end), next_(begin) {
  if (begin_ < 0 || begin_ >= end_ || end_ > renderer_->size())
    throw InputError("scene " + renderer_->scene().name,
                     "frames " + std::to_string(begin_) + ":" + std::to_string(end_) + " are not in it",
                     "it has frames 0:" + std::to_string(renderer_->size()));
}

std::vector<std::pair<std::string, std::string>> RenderedSource::details() const {
  return {{"seed", std::to_string(renderer_->scene().seed)},
          {"surfaces", std::to_string(renderer_->scene().world->surfaces.size())}};
}

std::vector<Timestamp> RenderedSource::times() const {
  const std::vector<Timestamp>& all = renderer_->scene().times;
  return {all.begin() + begin_, all.begin() + end_};
}

std::optional<Frame> RenderedSource::next() {
  if (next_ >= end_) return std::nullopt;
  const int index = next_++;
  return Frame{index, renderer_->scene().times[size_t(index)], renderer_->render_image(index)};
}

bool RenderedSource::skip() {
  if (next_ >= end_) return false;
  ++next_;
  return true;
}

}  // namespace edgevo
