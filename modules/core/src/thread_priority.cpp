// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/thread_priority.h"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstring>

namespace edgevo {

void lower_thread_priority() {
  constexpr int kNice = 10;
  (void)setpriority(PRIO_PROCESS, id_t(gettid()), kNice);
}

std::string raise_thread_priority(int priority) {
  sched_param parameter{};
  parameter.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO | SCHED_RESET_ON_FORK, &parameter);
  return error == 0 ? std::string() : std::strerror(error);
}

}  // namespace edgevo
