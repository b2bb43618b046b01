// SPDX-License-Identifier: BSD-3-Clause
#include "scale_groups.h"

namespace edgevo {

ScaleGroups::Member ScaleGroups::find(NodeId id) const {
  Member member{id, 0};
  for (auto p = parent_.find(id); p != parent_.end(); p = parent_.find(member.root)) {
    member.root = p->second.root;
    member.offset += p->second.offset;
  }
  return member;
}

std::optional<double> ScaleGroups::between(NodeId from, NodeId to) const {
  const Member a = find(from), b = find(to);
  if (a.root != b.root) return std::nullopt;
  return b.offset - a.offset;
}

void ScaleGroups::tie(NodeId from, NodeId to, double log_ratio) {
  const Member a = find(from), b = find(to);
  if (a.root == b.root) return;
  const double root_ratio = a.offset + log_ratio - b.offset;  // log s(root of to) - log s(root of from)
  if (a.root < b.root)
    parent_.insert_or_assign(b.root, Member{a.root, root_ratio});
  else
    parent_.insert_or_assign(a.root, Member{b.root, -root_ratio});
  // Short ways to the root: chains of thousands of rigid constraints stay fast.
  for (const NodeId id : {from, to}) {
    const Member m = find(id);
    if (m.root != id) parent_.insert_or_assign(id, m);
  }
}

}  // namespace edgevo
