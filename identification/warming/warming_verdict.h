// Whether a recording shows the warm-up, and whether its two parameters can be told apart.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace warmjoint {

/// The drop of |e|^2 / s^2 that warming must bring to count as seen: by chance it exceeds 20 about
/// once in 5000 recordings, a chi-square of 2 degrees of freedom at the best of about 5 independent time
/// constants.
inline constexpr double kVisibleWarming = 20;

/// Standard deviation of ln(tau) from which tau counts as unknown: 95 % within a factor of e.
inline constexpr double kImpreciseLogTau = 0.5;

/// The same where the interval of tau reaches beyond the recording. Then 1/tau = 0, a joint that
/// never settles, has to be excluded, by 4 deviations: whatever passes a weaker test there is what
/// chance made to look short, and its gain with it, which is known by k/tau alone.
inline constexpr double kImpreciseLongLogTau = 0.25;

/// A time constant below which nothing is heat: a second, or five samples of a step (s). What follows the losses faster is a
/// lag of the torque or the velocity, or what friction does at turns.
/// why: gears warm within minutes; over five samples a delay of one is a fifth of the time constant
inline double FastestWarming(double step) { return std::max(1.0, 5 * step); }

/// What a fit says of its warm-up.
struct WarmingEvidence {
  double explained = 0;      // drop of |e|^2 by warming, over the noise's variance
  double log_deviation = 0;  // standard deviation of ln(tau)
  double time_constant = 0;  // tau, s
  double shortest = 0;       // s, range of time constants that the recording can show
  double longest = std::numeric_limits<double>::infinity();
  double duration = std::numeric_limits<double>::infinity();  // s, of the recording
  double step = 0;                                            // s, of the recording
};

/// What stands beside the warming in a fit, and what to use where no warming can be seen.
struct WarmingContext {
  std::string_view beside;  // "", or words that begin with a blank
  std::string_view instead = "nominal-ls";
};

/// Why the warm-up cannot be seen at all: one sentence; nothing where it can.
std::optional<std::string> InsignificantWarming(double explained,
                                                const WarmingContext& context = {});

/// Why a fit whose tau ran away cannot be told: nothing of tau beyond the recording is known, and
/// of the gain by k/tau alone; nothing where it did not.
std::optional<std::string> RunawayWarming(double time_constant, double duration);

/// Why thermal gain and time constant cannot be told; nothing where they can.
std::optional<std::string> UnidentifiableWarming(const WarmingEvidence& evidence,
                                                 const WarmingContext& context = {});

}  // namespace warmjoint
