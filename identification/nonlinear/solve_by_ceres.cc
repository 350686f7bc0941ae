#include "identification/nonlinear/solve_by_ceres.h"

#include <glog/logging.h>

#include <algorithm>

namespace warmjoint {

void QuietCeres() {
  // glog reads its level unguarded: set once, before the first fit of any thread
  [[maybe_unused]] static const int level =
      (FLAGS_minloglevel = std::max(FLAGS_minloglevel, google::GLOG_FATAL));
}

}  // namespace warmjoint
