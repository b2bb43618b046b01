#pragma once
#include <string>

#include "edgevo/core/records.h"

namespace edgevo::app {

/// The lines on stdout that tell what a run has found and where it lies.
void print_run(const Run& run, const std::string& out);

}  // namespace edgevo::app
