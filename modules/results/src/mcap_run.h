// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/mcap_output/mcap_output.h"
#include "edgevo/results/recovery_log.h"
#include "edgevo/results/run_maps.h"

namespace edgevo {

/// What run.mcap needs to know before the first frame.
McapRun mcap_run(const RecoveryHeader& header, const MapParams& map);

}  // namespace edgevo
