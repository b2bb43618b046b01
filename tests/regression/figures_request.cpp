// SPDX-License-Identifier: BSD-3-Clause
#include "figures_request.h"

#include <algorithm>
#include <cstdlib>

#include "edgevo/core/error.h"
#include "edgevo/core/params.h"
#include "edgevo/simulation/relit_source.h"
#include "edgevo/simulation/rendered_source.h"

namespace edgevo::test {

void parse_figures_request(const std::vector<std::string>& args, const std::string& usage,
                           const std::function<bool(const std::string& name, const std::string& value)>& own,
                           FiguresRequest* request) {
  if (args.size() < 2) throw InputError("arguments", "too few", "usage: " + usage);
  request->scene = args[0];
  request->seed = std::strtoull(args[1].c_str(), nullptr, 10);
  if (args.size() > 2) request->light = args[2];
  for (size_t i = 3; i < args.size(); ++i) {
    const size_t equals = std::min(args[i].find('='), args[i].size());
    const std::string name = args[i].substr(0, equals),
                      value = args[i].substr(std::min(equals + 1, args[i].size()));
    if (name == "frames")
      request->frames = std::atoi(value.c_str());
    else if (!own(name, value))
      set_param(args[i], [&](ParamVisitor& v) { request->params.visit(v); });
  }
}

std::unique_ptr<ImageSource> images_of(const FiguresRequest& request,
                                       const std::shared_ptr<const SceneRenderer>& renderer) {
  std::unique_ptr<ImageSource> images = std::make_unique<RenderedSource>(renderer, 0, request.frames);
  if (request.light != "-")
    images = std::make_unique<RelitSource>(std::move(images), Relight(request.light, request.seed));
  return images;
}

}  // namespace edgevo::test
