// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rendered scene as a survey in the layout of Symphony Lake.
#include <functional>
#include <string>

#include "edgevo/simulation/scene_renderer.h"
#include "edgevo/symphony_lake/survey_writer.h"

namespace edgevo {

/// Default date of a rendered survey: the middle of its scene's season.
std::string usual_survey_name(const std::string& season);

/// Writes frames begin <= index < end, from noon (UTC) of the survey's date on. `on_frame_done` receives the
/// number of frames done, one call at a time. Throws InputError.
void write_survey(const SceneRenderer& renderer, const SurveyLocation& location, int begin, int end,
                  const std::function<void(int)>& on_frame_done);

}  // namespace edgevo
