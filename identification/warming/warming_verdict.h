// Whether a recording shows the warm-up, and whether its two parameters can be distinguished.
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
/// never settles, has to be excluded, by 4 deviations. Time constants that passed only a weaker test
/// would be those that chance made look short, and with them the gain, which is known by k/tau alone.
inline constexpr double kImpreciseLongLogTau = 0.25;

/// A time constant below which nothing is heat: a second, or five samples of a step (s). A force that follows the losses faster
/// is a lag of the torque or the velocity, or friction that changes at turns.
/// why: gears warm within minutes; over five samples a delay of one is a fifth of the time constant
inline double FastestWarming(double step) { return std::max(1.0, 5 * step); }

/// The figures of a fit that show how well its warm-up is determined.
struct WarmingEvidence {
  double explained = 0;      // drop of |e|^2 by warming, over the noise's variance
  double log_deviation = 0;  // standard deviation of ln(tau)
  double time_constant = 0;  // tau, s
  double shortest = 0;       // s, range of time constants that the recording can show
  double longest = std::numeric_limits<double>::infinity();
  double duration = std::numeric_limits<double>::infinity();  // s, of the recording
  double step = 0;                                            // s, of the recording
};

/// What a fit has besides the warming, and what to use where no warming can be seen.
struct WarmingContext {
  std::string_view beside;  // "", or words that begin with a blank
  std::string_view instead = "nominal-ls";
};

/// Why the warm-up cannot be seen at all: one sentence; nothing where it can.
std::optional<std::string> InsignificantWarming(double explained,
                                                const WarmingContext& context = {});

/// Why a fit whose tau ran away is not identifiable: nothing is known of a tau beyond the recording, and the
/// gain is known by k/tau alone. Returns nothing where tau did not run away.
std::optional<std::string> RunawayWarming(double time_constant, double duration);

/// Why thermal gain and time constant are not identifiable; nothing where they are.
std::optional<std::string> UnidentifiableWarming(const WarmingEvidence& evidence,
                                                 const WarmingContext& context = {});

}  // namespace warmjoint
