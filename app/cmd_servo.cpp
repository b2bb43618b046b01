// SPDX-License-Identifier: BSD-3-Clause
#include "become.h"
#include "commands.h"
#include "edgevo/files/program_folder.h"

namespace edgevo::app {

// The actual program is servo_main.cpp: it links ViSP, which has another licence (see LICENSE). It is next to
// this one, in a build and in an installation.
void add_servo_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "servo", "simulate visual servoing: ViSP's control laws with the odometry as the only sensor");
  command->prefix_command();
  command->set_help_flag();  // edgevo-servo also answers --help
  command->callback([=] {
    std::vector<std::string> words{"edgevo", "servo"};
    for (const std::string& word : command->remaining()) words.push_back(word);
    *action = [words]() -> int {
      become(program_folder() / "edgevo-servo", words,
             "install the package edgevo-servo, or build with ViSP (EDGEVO_WITH_VISP=ON)");
    };
  });
}

}  // namespace edgevo::app
