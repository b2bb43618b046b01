// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The window of `edgevo run --view`. GTK and forty more libraries come with it, whose symbols take a third of
// a program's start: only the program edgevo-view links them, which is edgevo-commands otherwise.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/map/map_log.h"
#include "edgevo/run_session/run_session.h"

namespace edgevo::app {

/// Returns in edgevo-view. Elsewhere replaces this process with edgevo-view, called with these words; throws
/// InputError if it cannot be run.
void become_program_with_window(const std::vector<std::string>& words);

/// RunView::open (run_view.h) and RunView::show with `stop`; empty where the window does not open. For use
/// after become_program_with_window().
ShowFrame open_view_window(const std::optional<SE3>& T_vehicle_cam, std::shared_ptr<MapLog> log,
                           std::function<bool()> stop, std::string* why);

}  // namespace edgevo::app
