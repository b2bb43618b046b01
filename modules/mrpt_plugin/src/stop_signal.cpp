// SPDX-License-Identifier: BSD-3-Clause
#include "stop_signal.h"

#include <csignal>

namespace edgevo {
namespace {

volatile std::sig_atomic_t came = 0;

void remember(int) { came = 1; }

void listen_to(int signal) {
  struct sigaction now {};
  if (sigaction(signal, nullptr, &now) != 0 || now.sa_handler != SIG_DFL) return;
  struct sigaction once {};
  once.sa_handler = remember;
  once.sa_flags = SA_RESTART | SA_RESETHAND;  // a camera's read goes on
  sigaction(signal, &once, nullptr);
}

}  // namespace

void listen_for_stop() {
  came = 0;
  listen_to(SIGINT);
  listen_to(SIGTERM);
}

bool stop_requested() { return came; }

}  // namespace edgevo
