#include "become.h"
#include "commands.h"
#include "edgevo/files/program_folder.h"

namespace edgevo::app {

// The program proper is servo_main.cpp: it links ViSP, whose licence is not this program's (see LICENSE). It
// lies next to this one, in a build as in an installation.
void add_servo_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "servo", "closed loop in the simulator: ViSP's control laws with the odometry as their only sensor");
  command->prefix_command();
  command->set_help_flag();  // --help, too, is answered over there
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
