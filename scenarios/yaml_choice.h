// Values of YAML that are one word of a few.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "scenarios/yaml_value.h"

namespace warmjoint::inline scenarios {

template <typename T>
using Choices = std::vector<std::pair<std::string, T>>;

/// What the word stands for; refuses others, with the nearest.
template <typename T>
T ReadChoice(const YamlValue& value, const Choices<T>& choices) {
  const std::string word = value.Text();
  std::vector<std::string> known;
  for (const auto& [name, choice] : choices) {
    if (name == word) return choice;
    known.push_back(name);
  }
  Refuse(value.place(), "{} is '{}'{}", value.key(), Excerpt(word), Suggestion(word, known));
}

/// The inverse.
template <typename T>
std::string ChoiceName(T value, const Choices<T>& choices) {
  for (const auto& [name, choice] : choices) {
    if (choice == value) return name;
  }
  return "";
}

}  // namespace warmjoint::inline scenarios
