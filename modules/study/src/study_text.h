// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// study.md: the paper's four observations as evaluated from the tables, with further figures.
#include <string>

#include "edgevo/study/study.h"

namespace edgevo {

std::string study_text(const StudyResult& result);

}  // namespace edgevo
