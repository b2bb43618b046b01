// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/sequence_output/sequence_host.h"

namespace edgevo::app {

/// Notices, progress display and output of this program, for written sequences.
SequenceHost sequence_host();

}  // namespace edgevo::app
