// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which methods are run with which settings at which frame distance.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/study/study.h"
#include "pair_matcher.h"

namespace edgevo {

/// Light of the second image of a pair.
inline constexpr const char* kStudyLights[] = {"normal", "changed"};

struct Experiment {
  std::string curve, method, setting;
  /// Position of the setting on the axis.
  int position = 0;
  /// Number of frames between host and target.
  int distance = 1;
  /// True if the errors of individual matches are kept.
  bool keeps_errors = false;
  /// Matching method; null: the pose of the front-end is used.
  std::shared_ptr<const PairMatcher> matcher;
};

std::vector<Experiment> make_experiments(const StudyOptions& options);

}  // namespace edgevo
