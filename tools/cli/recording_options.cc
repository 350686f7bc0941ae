#include "tools/cli/recording_options.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/recording/table_format.h"
#include "scenarios/yaml.h"
#include "tools/cli/typed_options.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// The project file beside the recordings; empty where there is none.
fs::path ProjectFileOf(const std::vector<std::string>& recordings) {
  // all recordings beside the same file, or all beside none
  std::optional<fs::path> found;
  for (const std::string& recording : recordings) {
    const fs::path file = fs::path(recording).parent_path() / kProjectFile;
    std::error_code ignored;
    const bool here = fs::exists(file, ignored);
    if (here && !fs::is_regular_file(file, ignored)) {
      Refuse({file.string()}, "is not a regular file; give --no-project to leave it out");
    }
    // links to one file are one file
    const fs::path one = here ? fs::weakly_canonical(file, ignored) : fs::path();
    if (found && *found != one) {
      Refuse({recording},
             "does not lie beside the project file of the other recordings, which may be of "
             "another joint; give --no-project, and the options that describe them");
    }
    found = one;
  }
  if (!found || found->empty()) return {};
  // by the name under which the first recording stands, not by one behind links
  return fs::path(recordings.front()).parent_path() / kProjectFile;
}

/// Whether an option stands on the command line.
bool IsGiven(const CLI::App& parser, const std::string& option) {
  const CLI::Option* found = parser.get_option_no_throw(option);
  return found && found->count() > 0;
}

/// What the project adds to the command line.
class Taking {
 public:
  explicit Taking(const CLI::App& parser) : parser_(parser) {}

  /// Adds what is said of columns that the command line does not name, and leaves that alone in `from`.
  template <typename T>
  void Pairs(const char* name, T& from, T& into) {
    std::erase_if(from, [&](const auto& entry) { return into.contains(entry.first); });
    std::vector<std::string> words;
    for (const auto& [column, value] : from) {
      into[column] = value;
      words.push_back(fmt::format("{}={}", column, value));
    }
    if (!words.empty()) Note(name, fmt::format("{}", fmt::join(words, ",")));
  }

  /// Takes a value that the command line does not give, and empties `from` where it does.
  template <typename T>
  void Value(const char* name, std::optional<T>& from, T& into) {
    // keys of the file are called as the options, with underscores
    std::string option = std::string("--") + name;
    std::replace(option.begin(), option.end(), '_', '-');
    if (IsGiven(parser_, option)) from.reset();
    if (!from) return;
    into = *from;
    if constexpr (std::is_enum_v<T>) {
      Note(name, std::string(NameOf(*from)));
    } else {
      Note(name, fmt::format("{}", *from));
    }
  }

  /// The same of names.
  void Names(const char* name, std::vector<std::string>& from, std::vector<std::string>& into) {
    if (IsGiven(parser_, std::string("--") + name)) from.clear();
    if (from.empty()) return;
    into = from;
    Note(name, fmt::format("{}", fmt::join(from, ",")));
  }

  const std::string& words() const { return words_; }

 private:
  void Note(const char* name, const std::string& text) {
    words_ += fmt::format("{}{} {}", words_.empty() ? "" : "; ", name, Excerpt(text));
  }

  const CLI::App& parser_;
  std::string words_;
};

/// Whether a sign follows a name of a column or of a converted field, as torque=, q1= or elbow.position=.
bool BeginsWithKey(std::string_view text) {
  const auto is_of_key = [](unsigned char c) {
    return std::isalnum(c) ||
           std::string_view("_ .[]/").find(static_cast<char>(c)) != std::string_view::npos;
  };
  const auto end = std::ranges::find_if_not(text, is_of_key);
  return end != text.end() && *end == '=';
}

/// The pairs of a list: a comma parts two where a key and a sign follow it, since names have commas, too.
std::vector<std::string> SplitPairs(std::string_view list) {
  std::vector<std::string> pairs;
  for (std::size_t begin = 0, at = 0; at <= list.size(); ++at) {
    if (at < list.size() && list[at] != ',') continue;
    const std::string_view rest = list.substr(std::min(at + 1, list.size()));
    if (at < list.size() && !BeginsWithKey(rest)) continue;
    pairs.emplace_back(list.substr(begin, at - begin));
    begin = at + 1;
  }
  return pairs;
}

/// Adds an option for pairs column=value, as --map torque=force_N,time=t_s. A value may stand in quotes.
CLI::Option* AddPairs(CLI::App& parser, const char* name, const char* description,
                      const std::function<void(const std::string&, const std::string&)>& take) {
  const auto read = [name, take](const std::vector<std::string>& lists) {
    std::vector<std::string> pairs;
    for (const std::string& list : lists)
      std::ranges::move(SplitPairs(list), std::back_inserter(pairs));
    for (const auto& [column, value] : ReadPairs(pairs, name)) {
      const bool is_quoted = value.size() > 1 && value.front() == '"' && value.back() == '"';
      take(column, is_quoted ? value.substr(1, value.size() - 2) : value);
    }
  };
  return parser.add_option_function<std::vector<std::string>>(name, read, description)->take_all();
}

}  // namespace

void AddRecordingOptions(CLI::App& parser, RecordingSource& source) {
  AddValue(parser, "RECORDING", "RECORDING", source.files,
           "table of text, HDF5 or MATLAB file, or - for a text on standard input; several of one "
           "joint, each from a cold start")
      ->required();
  AddLayoutOptions(parser, source.read);
}

void AddLayoutOptions(CLI::App& parser, ReadSettings& settings) {
  BeginGroup(parser, "How the file is read");
  // columns: their names, units and factors
  AddPairs(parser, "--map", "columns of the file, as position=q,velocity=dq,torque=tau,time=t",
           [&settings](const auto& column, const auto& text) { settings.map[column] = text; })
      ->type_name("COLUMN=NAME");
  AddPairs(parser, "--unit", "units of the file, as position=deg,time=ms",
           [&settings](const auto& column, const auto& text) { settings.unit[column] = text; })
      ->type_name("COLUMN=UNIT");
  const auto scale = [&settings](const std::string& column, const std::string& text) {
    const std::optional<double> factor = ParseFinite(text);
    if (factor && *factor != 0) settings.scale[column] = *factor;
    if (factor && *factor != 0) return;
    Refuse({"--scale"}, "{}={}: the factor must be a finite number other than 0", Excerpt(column),
           Excerpt(text));
  };
  AddPairs(parser, "--scale", "factors on the columns of the file, as torque=-1,velocity=0.5",
           scale)
      ->type_name("COLUMN=NUMBER");

  // the joint and its drive
  AddChoice(
      parser, "--joint", settings.joint,
      "kind of the joint: rotary, with position in rad and torque in N.m, or linear, with m "
      "and N",
      {{"prismatic", "linear"}, {"revolute", "rotary"}, {"hinge", "rotary"}, {"slide", "linear"}});
  AddValue(parser, "--gear", "NUMBER", settings.gear, "motor turns for each joint turn")
      ->capture_default_str();
  AddValue(parser, "--torque-constant", "NUMBER", settings.torque_constant,
           "torque of the joint for each ampere, N.m/A or N/A with the gear in it; makes N.m or N "
           "of --unit torque=A");

  // files without a header, or without a clock
  const auto columns = [&settings](const std::string& list) {
    std::vector<std::string_view> names;
    SplitLine(list, ',', names);
    settings.columns.assign(names.begin(), names.end());
  };
  parser
      .add_option_function<std::string>(
          "--columns", columns, "names of all columns of a text file, in place of its header")
      ->type_name("NAME,...");
  AddValue(parser, "--rate", "HZ", settings.rate, "samples in a second of a file without time, Hz");

  // sensors that wrap
  AddValue(parser, "--wrap", "NUMBER", settings.wrap,
           "range after which the position starts again, in its unit; a turn is undone anyway");
  parser.add_flag("--no-project")->description("leave out the warmjoint.yaml beside the recording");
}

void TellNotes(const PreparedLog& log) {
  for (const std::string& note : log.raw().measurements.notes) SayNotice("notice: {}\n", note);
}

void AddHoldOptions(CLI::App& parser, PrepareSettings& holds) {
  // both in seconds, at least 0
  const NumberRange seconds{0, std::numeric_limits<double>::infinity(), "of 0 or more, s"};
  AddNumber(parser, "--trim", holds.trim, seconds,
            "s to leave out at each end of a constant speed");
  AddNumber(parser, "--shortest-hold", holds.shortest_hold, seconds,
            "s; a constant speed that lasts less is left out");
}

std::vector<fs::path> InputsOf(const RecordingSource& source) {
  std::vector<fs::path> inputs(source.files.begin(), source.files.end());
  if (source.project) inputs.emplace_back(source.project->file);
  return inputs;
}

void AddFollowOptions(CLI::App& parser, EarlierRecording& earlier) {
  AddValue(parser, "--follows", "FILE", earlier.file,
           "recording before this one, or its estimate.json: the heat that it left is there at the "
           "start, less what cooled in the pause between");
  AddValue(parser, "--pause", "SECONDS", earlier.pause,
           "s of rest between the end of --follows and the start of the recording; where their "
           "stamps share a clock, these tell it");
}

void TakeProject(const CLI::App& parser, RecordingSource& arguments) {
  if (IsGiven(parser, "--no-project")) return;
  // no option and no file: nothing to take
  const fs::path file = ProjectFileOf(arguments.files);
  if (file.empty()) return;

  Project project = ParseProject(ReadWholeFile(file, kLargestDocument), file);
  Taking taking(parser);
  // by column
  ReadSettings& read = arguments.read;
  taking.Pairs("map", project.map, read.map);
  taking.Pairs("unit", project.unit, read.unit);
  taking.Pairs("scale", project.scale, read.scale);

  // as a whole
  taking.Names("columns", project.columns, read.columns);
  taking.Value("rate", project.rate, read.rate);
  taking.Value("wrap", project.wrap, read.wrap);
  taking.Value("joint", project.joint, read.joint);
  taking.Value("gear", project.gear, read.gear);
  taking.Value("trim", project.trim, arguments.prepare.trim);
  taking.Value("shortest_hold", project.shortest_hold, arguments.prepare.shortest_hold);

  // it is remembered with the estimate, and told
  arguments.project = TakenProject{file.string(), project};
  SayNotice("{}: {}\n", file.string(),
            taking.words().empty() ? "sets nothing that the command line does not"
                                   : taking.words() + " (--no-project leaves it out)");
}

}  // namespace warmjoint
