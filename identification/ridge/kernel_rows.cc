#include "identification/ridge/kernel_rows.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kMostValues = 1 << 24;  // 128 MiB, if every kernel counted at every sample

}  // namespace

KernelRows::KernelRows(const std::vector<FrictionMap>& maps, const MapPoints& points, Index spans)
    : samples_(points.rows()), kernels_(KernelCount(maps)) {
  for (Index i = 0; i < spans; ++i) {
    groups_.push_back(GroupRows(maps, points, i * samples_ / spans, (i + 1) * samples_ / spans));
  }
}

bool KernelRows::Fit(const std::vector<FrictionMap>& maps, Index samples) {
  return samples * KernelCount(maps) <= kMostValues;
}

std::shared_ptr<const KernelRows> KernelRows::Kept(const std::vector<FrictionMap>& maps,
                                                   const MapPoints& points, Index spans) {
  if (!Fit(maps, points.rows())) return nullptr;
  return std::make_shared<const KernelRows>(maps, points, spans);
}

NormalEquations KernelRows::Normal(Index span, const Eigen::MatrixXd& free,
                                   const Eigen::VectorXd& y) const {
  NormalEquations normal(free.cols() + kernels_);
  AddGroups(groups_[static_cast<size_t>(span)], free, y, normal);
  return normal;
}

NormalEquations KernelRows::Normal(const Eigen::MatrixXd& free, const Eigen::VectorXd& y) const {
  NormalEquations normal(free.cols() + kernels_);
  for (const std::vector<RowGroup>& span : groups_) AddGroups(span, free, y, normal);
  return normal;
}

Eigen::MatrixXd KernelRows::Products(const Eigen::Ref<const Eigen::MatrixXd>& y) const {
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(kernels_, y.cols());
  for (const std::vector<RowGroup>& span : groups_) AddProducts(span, y, products);
  return products;
}

Eigen::VectorXd KernelRows::Times(const Eigen::VectorXd& weights) const {
  Eigen::VectorXd values(samples_);
  for (const std::vector<RowGroup>& span : groups_) {
    for (const RowGroup& group : span) {
      values(group.samples) = group.values * weights(group.kernels);
    }
  }
  return values;
}

}  // namespace warmjoint
