#include "worlds.h"
namespace edgevo {
void build_lakeshore(Site&) {}
void build_corridor(Site&) {}
void build_plaza(Site&) {}
}
