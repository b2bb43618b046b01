// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Another source under changed light: its frames, from a folder, a rawlog or a renderer, pass through
// Relight.
#include <memory>

#include "edgevo/core/wrapped_source.h"
#include "edgevo/simulation/relight.h"

namespace edgevo {

/// A source under changed light.
class RelitSource : public WrappedSource {
 public:
  /// `source` is not null.
  RelitSource(std::unique_ptr<ImageSource> source, Relight relight)
      : WrappedSource(std::move(source)), relight_(std::move(relight)) {}

  /// Number of frames of the source; nullopt if frames may be dropped.
  std::optional<int> size() const override;
  std::string kind() const override { return inner().kind() + ", relit"; }
  /// Times of the source; empty if frames may be dropped.
  std::vector<Timestamp> times() const override;
  std::optional<Frame> next() override;
  /// A dropped frame is not skipped, but the next one.
  bool skip() override { return next().has_value(); }

 private:
  Relight relight_;
  std::optional<Timestamp> begin_;
};

}  // namespace edgevo
