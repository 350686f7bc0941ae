#include "tools/cli/robot_options.h"

#include <limits>
#include <vector>

#include "identification/fields/field_set.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "tools/cli/typed_options.h"

namespace warmjoint {
namespace {

/// The parts of a list with commas.
std::vector<std::string> SplitAtCommas(const std::string& list) {
  std::vector<std::string> parts(1);
  for (const char c : list) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// Calls take(key, value) for each KEY=VALUE of lists with commas; without a sign the key is empty.
template <typename Take>
void AddPairs(CLI::App& parser, const char* name, const char* form, const char* description,
              const Take& take) {
  const auto read = [name, take](const std::vector<std::string>& lists) {
    for (const std::string& list : lists) {
      for (const std::string& pair : SplitAtCommas(list)) {
        const std::size_t equals = pair.find('=');
        const bool has_key = equals != std::string::npos;
        take(name, has_key ? pair.substr(0, equals) : std::string(),
             has_key ? pair.substr(equals + 1) : pair);
      }
    }
  };
  parser.add_option_function<std::vector<std::string>>(name, read, description)
      ->type_name(form)
      ->take_all();
}

double NumberIn(const char* option, const std::string& key, const std::string& text) {
  const auto number = ParseFinite(text);
  if (!number) Refuse({option}, "{}='{}' is no finite number", Excerpt(key), Excerpt(text));
  return *number;
}

/// --tool mass=..,com=X,Y,Z or unknown.
RobotTool ReadTool(const std::string& text) {
  RobotTool tool;
  if (text == "unknown") return {.known = ToolKnown::unknown};
  tool.known = ToolKnown::given;
  bool has_mass = false;
  std::size_t axis = 3;
  for (const std::string& part : SplitAtCommas(text)) {
    if (part.starts_with("mass=")) {
      tool.mass = NumberIn("--tool", "mass", part.substr(5));
      has_mass = true;
      continue;
    }
    const bool begins = part.starts_with("com=");
    if (begins) axis = 0;
    if (axis > 2)
      Refuse({"--tool"}, "'{}' is none of mass=KG, com=X,Y,Z and unknown", Excerpt(part));
    tool.centre[axis++] = NumberIn("--tool", "com", begins ? part.substr(4) : part);
  }
  if (!has_mass) Refuse({"--tool"}, "'{}' gives no mass: --tool mass=KG,com=X,Y,Z", Excerpt(text));
  if (axis < 3) {
    Refuse({"--tool"}, "'{}' gives {} of the three numbers of com: --tool mass=KG,com=X,Y,Z",
           Excerpt(text), axis);
  }
  return tool;
}

/// --inertials given, given:SHARE or exact.
double ReadInertials(const std::string& text) {
  if (text == "exact") return 0;
  if (text == "given") return RobotSettings{}.inertials;
  const auto share = text.starts_with("given:") ? ParseNumber(text.substr(6)) : std::nullopt;
  if (share && *share > 0 && *share <= 10) return *share;
  Refuse({"--inertials"}, "is '{}'; it must be given, given:SHARE with a share above 0, or exact",
         Excerpt(text));
}

}  // namespace

void TakeScale(const std::string& column, double factor, RobotSettings& settings) {
  const std::size_t dot = column.rfind('.');
  const std::string joint = dot == std::string::npos ? "" : column.substr(0, dot);
  const std::string of = dot == std::string::npos ? column : column.substr(dot + 1);
  if (of != "torque" && of != "position") {
    Refuse({"--scale"}, "'{}' is neither torque nor position, nor JOINT.torque or JOINT.position",
           Excerpt(column));
  }
  (of == "torque" ? settings.torque_scale : settings.position_scale)[joint] = factor;
}

void AddJointsOfLog(CLI::App& parser, RobotSettings& settings) {
  AddPairs(parser, "--joints", "NAMES",
           "joints of the robot that the log holds, in the order of its columns",
           [&settings](const char*, const std::string&, const std::string& value) {
             settings.joints.push_back(value);
           });
}

void AddRobotReading(CLI::App& parser, ReadSettings& read, RobotSettings& settings) {
  AddPairs(
      parser, "--map", "COLUMN=PATTERN",
      "columns of the file, as 'position=q_{j},torque=tau_{j},time=t': {j} counts from 0, {1..6} "
      "and {a|b|c} stand for each joint in order, {name} for its name",
      [&read](const char* option, const std::string& key, const std::string& value) {
        if (key != "position" && key != "torque" && key != "time") {
          Refuse({option}, "'{}' is none of time, position and torque", Excerpt(key));
        }
        read.map[key] = value;
      });
  AddPairs(parser, "--unit", "COLUMN=UNIT", "units in the file, as position=deg,torque=A",
           [&read](const char* option, const std::string& key, const std::string& value) {
             if (key != "position" && key != "torque" && key != "time") {
               Refuse({option}, "'{}' is none of time, position and torque", Excerpt(key));
             }
             read.unit[key] = value;
           });
  AddPairs(parser, "--scale", "COLUMN=NUMBER",
           "factors on columns: torque=-1, or of one joint, J4.torque=-1,J4.position=-1",
           [&settings](const char* option, const std::string& key, const std::string& value) {
             TakeScale(key, NumberIn(option, key, value), settings);
           });
  AddPairs(parser, "--zero", "JOINT=NUMBER",
           "what the log reads where the description is at 0, rad or m: J4=1.5708",
           [&settings](const char* option, const std::string& key, const std::string& value) {
             settings.zero[key] = NumberIn(option, key, value);
           });
  AddPairs(parser, "--columns", "NAMES", "names of all columns of a text file without a header",
           [&read](const char*, const std::string&, const std::string& value) {
             read.columns.push_back(value);
           });
  AddNumber(parser, "--rate", read.rate, {0, kInfinity, "of 0 or more, Hz"},
            "rate of a log without time, Hz");
  AddJointsOfLog(parser, settings);
  AddPairs(parser, "--torque-constant", "JOINT=NUMBER",
           "N.m/A at the joint, for all or one joint: .1 or J4=.1",
           [&settings](const char* option, const std::string& key, const std::string& value) {
             settings.torque_constant[key] = NumberIn(option, key, value);
           });
}

void AddFittedRobot(CLI::App& parser, RobotSettings& settings) {
  AddPairs(parser, "--gear", "NUMBER",
           "motor turns for each turn of the joint, whose ripple is fitted: 101 or J4=101",
           [&settings](const char* option, const std::string& key, const std::string& value) {
             settings.gear[key] = NumberIn(option, key, value);
           });
  parser
      .add_option_function<std::string>(
          "--inertials",
          [&settings](const std::string& text) { settings.inertials = ReadInertials(text); },
          "how wrong masses, their places and inertias may be: given (a tenth), given:SHARE or "
          "exact")
      ->type_name("WORD");
}

void AddFields(CLI::App& parser, FieldSet& fields) {
  parser
      .add_option_function<std::string>(
          "--fields",
          [&fields](const std::string& text) {
            const auto set = FieldsIn(text);
            if (!set) Refuse({"--fields"}, "is '{}'; it must be {}", Excerpt(text), kWordsOfFields);
            fields = *set;
          },
          kFieldsHelp)
      ->type_name("LIST")
      ->default_str("auto");
}

void AddKnownRobot(CLI::App& parser, RobotSettings& settings) {
  parser
      .add_option_function<std::string>(
          "--tool", [&settings](const std::string& text) { settings.tool = ReadTool(text); },
          "a load at the last link that the description lacks: mass=KG,com=X,Y,Z in its axes, or "
          "unknown")
      ->type_name("TEXT");
  parser
      .add_option_function<std::string>(
          "--gravity",
          [&settings](const std::string& text) {
            settings.gravity.clear();
            for (const std::string& part : SplitAtCommas(text)) {
              settings.gravity.push_back(NumberIn("--gravity", "X,Y,Z", part));
            }
            if (settings.gravity.size() == 3) return;
            Refuse({"--gravity"}, "'{}' has {} numbers; it must be X,Y,Z, as 0,0,-9.81",
                   Excerpt(text), settings.gravity.size());
          },
          "m/s^2 in the description's axes, of a base that does not stand as described: X,Y,Z")
      ->type_name("TEXT");
  AddPairs(parser, "--at", "JOINT=NUMBER",
           "where a joint stands that the log does not hold, rad or m: waist=.5",
           [&settings](const char* option, const std::string& key, const std::string& value) {
             settings.at[key] = NumberIn(option, key, value);
           });
  AddValue(parser, "--coupling", "TEXT", settings.coupling,
           "a motor that turns with several joints, as J6=J5+J6")
      ->take_all();
  AddNumber(parser, "--cutoff", settings.cutoff, {.1, 1e4, "of .1 or more, Hz"},
            "low-pass of positions, torques and all that is fitted, Hz");
}

}  // namespace warmjoint
