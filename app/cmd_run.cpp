#include "commands.h"
#include "edgevo/core/error.h"

namespace edgevo::app {
void add_run_command(CLI::App&, Action*) {}
}  // namespace edgevo::app
