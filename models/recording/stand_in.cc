#include "models/recording/stand_in.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

const std::vector<StandIn>& StandIns() {
  static const std::vector<StandIn> all{
      {"a current", "A, mA or raw", {"current", "strom", "curr", "cur", "amp", "iq", "i"}},
      {"a voltage", "V, mV or raw", {"volt", "spannung"}},
      {"a duty cycle", "% or raw", {"duty", "pwm"}},
      {"a load", "%, raw or N.m", {"load", "auslastung"}}};
  return all;
}

/// The words of a name in small letters, as position, est of "PositionEst2"; digits and signs part them.
std::vector<std::string> WordsIn(std::string_view name) {
  std::vector<std::string> words;
  bool joins = false;  // whether the next letter goes on with the last word
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    const bool is_letter = std::isalpha(c) || c >= 0x80;
    const bool begins =
        std::isupper(c) && i > 0 && std::islower(static_cast<unsigned char>(name[i - 1]));
    if (is_letter && (!joins || begins)) words.emplace_back();
    if (is_letter) words.back() += Lowercase(name.substr(i, 1));
    joins = is_letter;
  }
  return words;
}

}  // namespace

const StandIn* StandInOf(const std::string& name) {
  const auto is_in = [](std::string_view part, const std::string& word) {
    return part.size() > 3 ? word.find(part) != std::string::npos : word == part;
  };
  const auto is_torque = [&](const std::string& word) {
    return std::ranges::any_of(std::array{"torque", "moment", "trq", "tau", "effort", "force"},
                               [&](std::string_view part) { return is_in(part, word); });
  };
  const StandIn* found = nullptr;
  bool of_torque =
      false;  // whether a torque was named before: of that a letter is an index, as in tau_i
  for (const std::string& word : WordsIn(name)) {
    if (is_torque(word)) {
      found = nullptr;
      of_torque = true;
      continue;
    }
    for (const StandIn& one : StandIns()) {
      const bool is_one = std::ranges::any_of(one.parts, [&](std::string_view part) {
        const bool is_vague = part == "i" || part == "load";
        return !(is_vague && of_torque) && is_in(part, word);
      });
      if (is_one && !found) found = &one;
    }
  }
  return found;
}

}  // namespace warmjoint
