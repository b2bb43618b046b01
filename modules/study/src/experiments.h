#pragma once
// Which methods are run with which settings at which frame distance.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/study/pair_matcher.h"
#include "edgevo/study/study.h"

namespace edgevo {

/// Of the second image of a pair.
inline constexpr const char* kStudyLights[] = {"normal", "changed"};

struct Experiment {
  std::string curve, method, setting;
  int position = 0;                            ///< of the setting on the axis
  int distance = 1;                            ///< frames
  bool keeps_errors = false;                   ///< of single matches
  std::shared_ptr<const PairMatcher> matcher;  ///< null: the pose as the front-end has it
};

std::vector<Experiment> make_experiments(const StudyOptions& options);

}  // namespace edgevo
