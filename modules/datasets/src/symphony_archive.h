// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Symphony Lake's archive: where its surveys and their maps lie.
//
//   ARCHIVE/VBags/SURVEY/image_auxilliary.csv          older copies
//   ARCHIVE/Dataset/20YY/SURVEY/image_auxilliary.csv   newer ones
//   ARCHIVE/Maps/SURVEY/optposes.csv
// A survey is named by its date, YYMMDD, sometimes followed by a letter. ARCHIVE may also be VBags or Dataset
// itself.
#include <string>
#include <vector>

#include "edgevo/datasets/surveys.h"

namespace edgevo {

/// Folder of the survey if `path` is ARCHIVE/SURVEY or an archive with a single survey; else `path` itself.
/// Throws InputError: an archive with several surveys (it lists them), two surveys of that name, none of that
/// name.
std::string survey_folder(const std::string& path);

/// Path of Maps/SURVEY/optposes.csv for a survey's folder, searched in the three folders above it; empty if
/// there is none.
std::string survey_map(const std::string& survey_folder);

/// Name of the survey in a folder.
std::string survey_name(const std::string& survey_folder);

}  // namespace edgevo
