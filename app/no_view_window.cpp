// SPDX-License-Identifier: BSD-3-Clause
// In edgevo-commands.
#include <stdexcept>

#include "become.h"
#include "edgevo/files/program_folder.h"
#include "view_window.h"

namespace edgevo::app {

void become_program_with_window(const std::vector<std::string>& words) {
  become(program_folder() / "edgevo-view", words, "install the package edgevo-view, or run without --view");
}

ShowFrame open_view_window(const std::optional<SE3>&, std::shared_ptr<MapLog>, std::function<bool()>,
                           std::string*) {
  throw std::logic_error("edgevo-commands has no window");
}

}  // namespace edgevo::app
