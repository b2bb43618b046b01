#pragma once
// study.md: what the numbers say about the paper's four observations, and the figures beside them.
#include <string>

#include "edgevo/study/study.h"

namespace edgevo {

std::string study_text(const StudyResult& result);

}  // namespace edgevo
