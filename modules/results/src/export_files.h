// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

#include "edgevo/results/run_folder.h"
#include "exporters/exporter.h"

namespace edgevo {

/// Writes the files of the run whose kind is `requested` and that apply to it; failures are recorded in
/// `folder`.
void export_files(const std::function<bool(FileKind)>& requested, ExportContext* context, RunFolder* folder);

}  // namespace edgevo
