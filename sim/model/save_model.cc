#include "sim/model/save_model.h"

#include <array>

namespace warmjoint::inline sim {

std::string ModelToXml(mjSpec& spec, const Place& place) {
  // as it was written, not as the compiler changed it
  spec.compiler.savecompiled = 0;
  spec.compiler.savecanonical = 0;

  // the first call tells how much room the second needs
  std::array<char, 1000> error{};
  std::string text(1, '\0');
  const int size = mj_saveXMLString(&spec, text.data(), 1, error.data(), error.size());
  if (size >= 0) {
    text.resize(static_cast<size_t>(size) + 1);
    if (mj_saveXMLString(&spec, text.data(), size + 1, error.data(), error.size()) == 0) {
      text.resize(text.find('\0'));
      return text;
    }
  }
  Refuse(place, "MuJoCo cannot write it as MJCF: {}", error.data());
}

}  // namespace warmjoint::inline sim
