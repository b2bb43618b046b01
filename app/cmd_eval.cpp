#include "commands.h"
#include "edgevo/core/error.h"

namespace edgevo::app {
void add_eval_command(CLI::App&, Action*) {}
}  // namespace edgevo::app
