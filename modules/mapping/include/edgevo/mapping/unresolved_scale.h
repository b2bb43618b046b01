// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The unit of length of before a doubt, where it is not known yet in the map after it.
//
// The first comparison comes when a doubt ends, and often finds nothing: the failure is still in the images
// that the new map was made of, or its depths are young. A camera that stays near one place sees again what
// it saw before. So the last view of the unit that was known is kept, and compared with later keyframes: less
// and less often, since a camera that travels on does not come back.
#include <vector>

#include "edgevo/confidence/integrity_monitor.h"
#include "edgevo/core/frame_evidence.h"

namespace edgevo {

/// When to compare the present map with views of before. For the tracking thread; keeps those views alive.
class UnresolvedScale {
 public:
  /// Notes what a comparison of `view`, at frame `frame_index`, with `before` has shown.
  void note(int frame_index, const std::vector<TrustedReference>& before, const TrustedReference& view,
            const RelativeScale& unit);
  /// Whether the unit of before is not known yet.
  bool is_open() const { return !before_.empty(); }
  /// Whether `view` is to be compared with before() at this frame: another keyframe than the last one that
  /// was compared, and half as long after it as that one after the first.
  bool is_due(int frame_index, const TrustedReference& view) const;
  /// The views whose unit is looked for, newest first; empty if it is known.
  const std::vector<TrustedReference>& before() const { return before_; }

 private:
  bool is_about(const std::vector<TrustedReference>& before) const;

  std::vector<TrustedReference> before_;
  int since_ = 0;           // frame of the first comparison
  int next_ = 0;            // frame
  int last_keyframe_ = -1;  // that was compared
};

}  // namespace edgevo
