// The way of a joint through positions with noise, between two constant speeds.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// Positions of a joint that turns round only where these lead back by more than `hysteresis`. Each
/// stretch from one turning point to the next is replaced by the monotone sequence nearest to it in
/// least squares (pool adjacent violators; Barlow et al., Statistical Inference under Order
/// Restrictions, 1972, 1.2), whose runs of equal values are joined by straight lines from middle to
/// middle. So noise and the steps of an encoder add nothing to the path sum |p[i+1] - p[i]|, which
/// telescopes, and little to its speed. time: [N] s; position: [N] rad or m; hysteresis: rad or m,
/// above the noise from peak to peak. Returns [N].
Eigen::VectorXd MonotonePath(const Eigen::VectorXd& time, const Eigen::VectorXd& position,
                             double hysteresis);

}  // namespace warmjoint
