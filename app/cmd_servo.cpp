#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/files/program_folder.h"

namespace edgevo::app {
namespace {

namespace fs = std::filesystem;

// Beside this program, as the build and the installation put them.
fs::path companion() { return program_folder() / "edgevo-servo"; }

[[noreturn]] void become(const fs::path& program, const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  throw InputError(program.string(), "cannot be run: " + std::string(std::strerror(errno)),
                   "install the package edgevo-servo, or build with ViSP (EDGEVO_WITH_VISP=ON)");
}

}  // namespace

// The program proper is app/servo: it links ViSP, whose licence is not this program's (see LICENSE).
void add_servo_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "servo", "closed loop in the simulator: ViSP's control laws with the odometry as their only sensor");
  command->prefix_command();
  command->set_help_flag();  // --help, too, is answered over there
  command->callback([=] {
    std::vector<std::string> words{"edgevo", "servo"};
    for (const std::string& word : command->remaining()) words.push_back(word);
    *action = [words]() -> int { become(companion(), words); };
  });
}

}  // namespace edgevo::app
