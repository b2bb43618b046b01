// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/study/study_report.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "edgevo/core/output_file.h"
#include "plot_script.h"
#include "study_tables.h"
#include "study_text.h"

namespace edgevo {

void write_study(const StudyResult& result, const std::string& folder) {
  make_output_folder(folder);
  for (const char* curve : {"search_length", "patch_size", "frame_distance", "residuals", "variants"})
    write_file(folder + "/" + curve + ".csv", curve_table(result, curve));
  write_file(folder + "/end_point_error.csv", end_point_table(result));
  write_file(folder + "/match_errors.csv", match_error_table(result));
  write_file(folder + "/confidence.csv", confidence_table(result));
  write_file(folder + "/confidence_areas.csv", confidence_area_table(result));
  write_file(folder + "/study.md", study_text(result));
  write_file(folder + "/plots.gnuplot", plot_script());
}

bool draw_plots(const std::string& folder) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const char* arguments[] = {"gnuplot", "plots.gnuplot", nullptr};
  pid_t child = 0;
  const bool started = posix_spawnp(&child, arguments[0], &actions, nullptr,
                                    const_cast<char* const*>(arguments), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return started && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace edgevo
