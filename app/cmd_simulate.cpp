#include "commands.h"
#include "edgevo/core/error.h"

namespace edgevo::app {
void add_simulate_command(CLI::App&, Action*) {}
}  // namespace edgevo::app
