#include "identification/ridge/envelope_cholesky.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace warmjoint {
namespace {

using Graph = std::vector<std::vector<Eigen::Index>>;
constexpr double kUnseen = 1e-17;
constexpr Eigen::Index kBlock = 48;  // columns that are factored at once

/// Neighbours of each column, those with the fewest neighbours first.
Graph Neighbours(const Eigen::MatrixXd& matrix) {
  const Eigen::Index n = matrix.rows();
  const Eigen::VectorXd scale = matrix.diagonal().cwiseAbs().cwiseSqrt();
  Graph graph(static_cast<size_t>(n));
  // entries that are not 0 beside their diagonals
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) {
      if (i != j && std::abs(matrix(i, j)) > kUnseen * scale[i] * scale[j]) graph[j].push_back(i);
    }
  }
  // neighbours with few neighbours of their own come first
  for (std::vector<Eigen::Index>& neighbours : graph) {
    std::stable_sort(neighbours.begin(), neighbours.end(), [&](Eigen::Index a, Eigen::Index b) {
      return graph[a].size() < graph[b].size();
    });
  }
  return graph;
}

/// Appends all that can be reached from `start`, nearest first.
void Walk(const Graph& graph, Eigen::Index start, std::vector<bool>& visited,
          std::vector<Eigen::Index>& order) {
  size_t next = order.size();
  order.push_back(start);
  visited[start] = true;
  for (; next < order.size(); ++next) {
    for (const Eigen::Index neighbour : graph[order[next]]) {
      if (visited[neighbour]) continue;
      visited[neighbour] = true;
      order.push_back(neighbour);
    }
  }
}

std::vector<Eigen::Index> ReverseCuthillMcKee(const Graph& graph) {
  std::vector<Eigen::Index> order;
  std::vector<bool> visited(graph.size(), false);
  for (size_t i = 0; i < graph.size(); ++i) {
    if (visited[i]) continue;
    // the farthest from anywhere lies at an end
    std::vector<bool> trial = visited;
    std::vector<Eigen::Index> reached;
    Walk(graph, static_cast<Eigen::Index>(i), trial, reached);
    Walk(graph, reached.back(), visited, order);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

EnvelopeCholesky::EnvelopeCholesky(const Eigen::MatrixXd& matrix) {
  // an order that keeps neighbours close keeps the envelope narrow
  const Graph graph = Neighbours(matrix);
  order_ = ReverseCuthillMcKee(graph);
  matrix_ = matrix(order_, order_);
  factor_ = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());

  // a row fills up from its first entry on
  const auto n = static_cast<Eigen::Index>(order_.size());
  std::vector<Eigen::Index> place(order_.size());
  for (Eigen::Index i = 0; i < n; ++i) place[order_[i]] = i;
  end_.resize(order_.size());
  std::iota(end_.begin(), end_.end(), 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::Index first = i;
    for (const Eigen::Index neighbour : graph[order_[i]]) first = std::min(first, place[neighbour]);
    end_[first] = std::max(end_[first], i + 1);
  }
  // columns of a block share the reach of the last, so that the reach may only grow
  for (Eigen::Index i = 1; i < n; ++i) end_[i] = std::max(end_[i], end_[i - 1]);
}

Eigen::Index EnvelopeCholesky::BlockSize(Eigen::Index begin) const {
  return std::min(kBlock, static_cast<Eigen::Index>(order_.size()) - begin);
}

bool EnvelopeCholesky::Factor(double shift) {
  const auto n = static_cast<Eigen::Index>(order_.size());
  // the lower half within the envelope
  for (Eigen::Index k = 0; k < n; k += kBlock) {
    const Eigen::Index width = BlockSize(k);
    const Eigen::Index height = end_[k + width - 1] - k;
    factor_.block(k, k, height, width) = matrix_.block(k, k, height, width);
  }
  factor_.diagonal().array() += shift;

  // block by block: factors of the corner, the panel below by them, and its products off the rest
  for (Eigen::Index k = 0; k < n; k += kBlock) {
    const Eigen::Index width = BlockSize(k);
    const Eigen::Index below = end_[k + width - 1] - k - width;
    Eigen::Ref<Eigen::MatrixXd> corner = factor_.block(k, k, width, width);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(corner);
    if (llt.info() != Eigen::Success) return false;
    if (below == 0) continue;
    auto panel = factor_.block(k + width, k, below, width);
    corner.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(panel);
    factor_.block(k + width, k + width, below, below)
        .selfadjointView<Eigen::Lower>()
        .rankUpdate(panel, -1);
  }
  return true;
}

Eigen::MatrixXd EnvelopeCholesky::Solve(const Eigen::MatrixXd& right) const {
  const auto n = static_cast<Eigen::Index>(order_.size());
  Eigen::MatrixXd x = right(order_, Eigen::all);
  // down through L
  for (Eigen::Index k = 0; k < n; k += kBlock) {
    const Eigen::Index width = BlockSize(k);
    const Eigen::Index below = end_[k + width - 1] - k - width;
    auto part = x.middleRows(k, width);
    factor_.block(k, k, width, width).triangularView<Eigen::Lower>().solveInPlace(part);
    x.middleRows(k + width, below) -= factor_.block(k + width, k, below, width) * part;
  }
  // up through its transpose
  for (Eigen::Index k = (n - 1) / kBlock * kBlock; k >= 0; k -= kBlock) {
    const Eigen::Index width = BlockSize(k);
    const Eigen::Index below = end_[k + width - 1] - k - width;
    auto part = x.middleRows(k, width);
    part -= factor_.block(k + width, k, below, width).transpose() * x.middleRows(k + width, below);
    factor_.block(k, k, width, width).triangularView<Eigen::Lower>().transpose().solveInPlace(part);
  }
  // in the order of the caller
  Eigen::MatrixXd result(n, right.cols());
  result(order_, Eigen::all) = x;
  return result;
}

}  // namespace warmjoint
