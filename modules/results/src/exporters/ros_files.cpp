// SPDX-License-Identifier: BSD-3-Clause
#include "exporters.h"

namespace edgevo {

void export_mcap(ExportContext* context, const std::string&) {
  context->mcap->finish(context->run, context->map.grid ? &*context->map.grid : nullptr);
}

bool has_mcap(const ExportContext& context) { return context.mcap != nullptr; }

}  // namespace edgevo
