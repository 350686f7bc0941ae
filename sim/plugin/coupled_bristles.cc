#include "sim/plugin/coupled_bristles.h"

#include "models/foundation/bad_input.h"

namespace warmjoint::inline sim {

CoupledBristles::CoupledBristles(const mjModel* m, const std::vector<CoupledJoint>& joints) {
  // a tree of the model for each that has joints of the instance
  for (int id = 0; id < m->ntree; ++id) {
    std::vector<CoupledJoint> own;
    for (const CoupledJoint& joint : joints) {
      if (m->dof_treeid[joint.dof] == id) own.push_back(joint);
    }
    if (own.empty()) continue;

    // each begins at an even row, so that pairs do not reach into another
    trees_.push_back({BristleTree(m, id, own), size_});
    const size_t own_size = trees_.back().tree.size();
    size_ += own_size + own_size % 2;
  }
}

size_t CoupledBristles::RowOf(int dof) const {
  for (const auto& [tree, first] : trees_) {
    const int place = dof - tree.first_dof();
    if (place >= 0 && place < static_cast<int>(tree.size())) {
      return first + static_cast<size_t>(place);
    }
  }
  Refuse({"bristles"}, "degree of freedom {} has none", dof);
}

}  // namespace warmjoint::inline sim
