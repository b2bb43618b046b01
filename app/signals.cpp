// SPDX-License-Identifier: BSD-3-Clause
#include "signals.h"

#include <csignal>

namespace edgevo::app {
namespace {

volatile std::sig_atomic_t signalled = 0;
void on_signal(int) { signalled = 1; }

}  // namespace

void listen_to_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupted() { return signalled != 0; }

}  // namespace edgevo::app
