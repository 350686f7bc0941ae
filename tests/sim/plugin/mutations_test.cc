// Attributes that someone mistyped: 1500 mutations, each refused with a sentence or stepped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "models/foundation/random_stream.h"
#include "models/friction/friction_json.h"
#include "tests/sim/plugin/two_forms.h"

namespace warmjoint {
namespace {

using namespace test;

/// One to four changes: bytes flipped, cut, doubled, or replaced by what numbers and JSON are of.
std::string Mutate(std::string text, RandomStream& random) {
  const std::string parts[] = {"-",  "1e9", "1e400", "nan",  "0",  "{", "]", ",", "\"",
                               "[]", "{}",  "null",  "true", "-0", ":", ".", "e", " "};
  const auto draw = [&](size_t below) {
    return static_cast<size_t>(random.Uniform(0, static_cast<double>(below)));
  };
  for (size_t changes = 1 + draw(4); changes > 0 && !text.empty(); --changes) {
    const size_t at = draw(text.size()), length = 1 + draw(std::min<size_t>(8, text.size() - at));
    switch (draw(4)) {
      case 0:
        text[at] = static_cast<char>(32 + draw(95));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.replace(at, draw(2) * length, parts[draw(std::size(parts))]);
    }
  }
  return text;
}

/// One to three digits are others, or become several.
std::string MutateNumbers(std::string text, RandomStream& random) {
  const char* const digits = "0123456789";
  const std::string parts[] = {"0", "7", "99", "-1", "1e3", "1e-9", "1e99", "."};
  for (auto changes = static_cast<int>(random.Uniform(1, 4)); changes > 0; --changes) {
    const auto from = static_cast<size_t>(random.Uniform(0, static_cast<double>(text.size())));
    const size_t at = text.find_first_of(digits, from);
    if (at == std::string::npos) continue;
    text.replace(at, 1, parts[static_cast<size_t>(random.Uniform(0, std::size(parts)))]);
  }
  return text;
}

/// The text of `joints` in ArmXml, mutated.
std::string MutatedArm(const Friction& friction, Form form, RandomStream& random) {
  std::string xml = ArmXml(friction, form, "implicitfast");
  const std::string begin = R"(key="joints" value=")";
  const size_t from = xml.find(begin) + begin.size(), to = xml.find('"', from);
  nlohmann::json joints;
  for (int i = 0; i < kArmJoints; ++i) joints[fmt::format("j{}", i)] = FrictionToTree(friction);
  const bool numbers = random.Uniform(0, 1) < 0.5;
  const std::string text =
      numbers ? MutateNumbers(joints.dump(), random) : Mutate(joints.dump(), random);
  return xml.replace(from, to - from, EscapeXml(text));
}

TEST(PluginMutations, AreRefusedInASentenceOrStepToFiniteStates) {
  const std::vector<Friction> frictions = FrictionsOfEveryLaw();
  int refused = 0, taken = 0;
  for (std::uint64_t run = 0; run < 1500; ++run) {
    RandomStream random({12, run}, Stream::test);
    const Form form = run % 2 == 0 ? Form::actuator : Form::passive;
    const std::string xml = MutatedArm(frictions[run % frictions.size()], form, random);
    SCOPED_TRACE(fmt::format("run {}", run));
    const Compiled compiled = Compile(xml);
    if (!compiled.model) {
      ++refused;
      // who, and more than a word
      const bool named = compiled.error.find("actuator") != std::string::npos ||
                         compiled.error.find("plugin instance 'arm'") != std::string::npos;
      EXPECT_TRUE(named) << compiled.error;
      EXPECT_GT(compiled.error.size(), 60U) << compiled.error;
      continue;
    }
    ++taken;
    const Data d(mj_makeData(compiled.model.get()));
    DriveArm(compiled.model.get(), d.get(), 300);
    for (const mjtNum x : FullState(compiled.model.get(), d.get())) ASSERT_TRUE(std::isfinite(x));
  }
  EXPECT_GT(refused, 500);
  EXPECT_GT(taken, 100);
}

}  // namespace
}  // namespace warmjoint
