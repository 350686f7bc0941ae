// How a map's weights lie along its first axis.
#pragma once

#include <warmjoint/friction.h>

#include <cstddef>

namespace warmjoint {

/// Kernels along the first axis: weight k lies at index k / stride of the line k % stride.
struct KernelLines {
  size_t length = 0, stride = 1;
  bool circular = false;

  explicit KernelLines(const FrictionMap& map)
      : length(map.axes[0].kernels.centres.size()),
        stride(map.size() / map.axes[0].kernels.centres.size()),
        circular(map.axes[0].kernels.period.has_value()) {}
};

}  // namespace warmjoint
