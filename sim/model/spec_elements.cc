#include "sim/model/spec_elements.h"

#include <regex>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

/// Whether the text holds more than letters that stand for themselves.
bool LooksLikePattern(const std::string& text) {
  return text.find_first_of("*+?[](){}|^$\\") != std::string::npos;
}

bool CarriesFriction(const mjsJoint& joint) {
  return joint.type == mjJNT_HINGE || joint.type == mjJNT_SLIDE;
}

/// What to write for a '*' that stands for any text as in the names of files; empty where none does.
std::string WildcardRemedy(const std::string& pattern) {
  std::string written;
  for (size_t i = 0; i < pattern.size(); ++i) {
    const bool repeats =
        i > 0 && std::string_view(".)]}*").find(pattern[i - 1]) != std::string::npos;
    if (pattern[i] == '*' && !repeats) written += '.';
    written += pattern[i];
  }
  return written == pattern ? "" : fmt::format("; for any text write '.*', as '{}'", written);
}

std::regex ReadPattern(const std::string& pattern, const Place& place) {
  try {
    return std::regex(pattern);
  } catch (const std::regex_error& error) {
    const std::string remedy = WildcardRemedy(pattern);
    Refuse(place, "'{}' is neither the name of a joint nor a regular expression{}",
           Excerpt(pattern), remedy.empty() ? fmt::format(": {}", error.what()) : remedy);
  }
}

}  // namespace

mjsJoint* FindJoint(mjSpec& spec, const std::string& joint, const Place& place) {
  mjsElement* found = mjs_findElement(&spec, mjOBJ_JOINT, joint.c_str());
  if (found) return mjs_asJoint(found);
  Refuse(place, "there is no joint '{}'{}", Excerpt(joint),
         Suggestion(joint, SpecNames(spec, mjOBJ_JOINT)));
}

std::vector<std::string> MatchJoints(mjSpec& spec, const std::string& pattern, const Place& place) {
  // a name goes before a pattern, also one with letters that patterns use
  const bool named = mjs_findElement(&spec, mjOBJ_JOINT, pattern.c_str()) != nullptr;
  if (named || !LooksLikePattern(pattern)) {
    FindJoint(spec, pattern, place);
    return {pattern};
  }

  // all hinges and slides whose whole name fits
  const std::regex expression = ReadPattern(pattern, place);
  std::vector<std::string> joints;
  for (mjsElement* element : SpecElements(spec, mjOBJ_JOINT)) {
    if (!CarriesFriction(*mjs_asJoint(element))) continue;
    std::string name = NameOf(element);
    if (!name.empty() && std::regex_match(name, expression)) joints.push_back(std::move(name));
  }
  if (!joints.empty()) return joints;
  const std::vector<std::string> names = SpecNames(spec, mjOBJ_JOINT);
  if (names.empty()) Refuse(place, "none of its {} joints has a name", NamelessJoints(spec));
  Refuse(place, "no hinge or slide joint matches the pattern '{}'; there are {}{}",
         Excerpt(pattern), ExcerptOfList(names), WildcardRemedy(pattern));
}

int NamelessJoints(mjSpec& spec) {
  int nameless = 0;
  for (mjsElement* element : SpecElements(spec, mjOBJ_JOINT)) {
    const bool named = !NameOf(element).empty();
    nameless += CarriesFriction(*mjs_asJoint(element)) && !named;
  }
  return nameless;
}

}  // namespace warmjoint
