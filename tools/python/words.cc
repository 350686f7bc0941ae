#include "tools/python/words.h"

#include <fmt/format.h>
#include <warmjoint/errors.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"

namespace warmjoint::python {
namespace {

/// What stands behind an option.
enum class Behind { pairs, number, word, name, flag, settings };

/// An option of the command line and the argument of Python's functions.
struct Spelling {
  std::string_view option, argument;
  Behind behind;
  std::string_view words = "";  // that may stand behind, with blanks around each
};

constexpr std::array kSpellings = std::to_array<Spelling>({
    // of read, Log and identify
    {"map", "map", Behind::pairs},
    {"unit", "unit", Behind::pairs},
    {"scale", "scale", Behind::pairs},
    {"columns", "columns", Behind::number},
    {"rate", "rate", Behind::number},
    {"wrap", "wrap", Behind::number},
    {"gear", "gear", Behind::number},
    {"torque-constant", "torque_constant", Behind::number},
    {"joint", "joint", Behind::word, " linear rotary "},
    {"trim", "trim", Behind::number},
    {"shortest-hold", "shortest_hold", Behind::number},
    {"recording", "log", Behind::word},
    // of identify
    {"identifier", "method", Behind::name},
    {"set", "options", Behind::settings},
    {"gravity", "gravity", Behind::word, " none sincos paired "},
    {"motion", "motion", Behind::word, " chosen constant any "},
    {"start", "start", Behind::word, " cold unknown estimated "},
    {"relevance", "relevance", Behind::number},
    {"holdout", "holdout", Behind::number},
    {"force", "force", Behind::flag},
    // of identify_robot
    {"cutoff", "cutoff", Behind::number},
    {"joints", "joints", Behind::number},
    {"inertials", "inertials", Behind::number},
    {"coupling", "coupling", Behind::number},
    {"tool", "tool", Behind::number},
    {"zero", "zero", Behind::pairs},
    {"at", "at", Behind::pairs},
    // of predict and attach
    {"initial", "initial", Behind::word, " cold end "},
    {"armature", "armatures", Behind::pairs},
    {"timestep", "timestep", Behind::number},
    {"stiffest-drive", "stiffest_drive", Behind::number},
    {"integrator", "integrator", Behind::word, " auto Euler RK4 implicit implicitfast "},
    {"approximate", "approximate", Behind::flag},
    // of export
    {"warm", "warm", Behind::number},
    {"speed", "speed", Behind::number},
    // of design
    {"limits", "limits", Behind::number},
    {"prior", "prior", Behind::word},
    {"noise", "noise", Behind::number},
    // of simulate and run
    {"realizations", "realizations", Behind::number},
    {"realization", "realization", Behind::number},
    {"seed", "seed", Behind::number},
    {"jobs", "jobs", Behind::number},
});

/// A part of a text: as it stands, or an argument with its value where one was given.
struct Piece {
  std::string text;                                       // as Python has it
  std::vector<std::pair<std::string, Tree>> arguments{};  // of an option with a value
  bool is_example = false;                                // whose value someone has to put in
};

bool IsName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool IsOption(char c) { return std::islower(static_cast<unsigned char>(c)) != 0 || c == '-'; }

/// Whether a text stands for a value, as NAME or FACTOR.
bool IsPlaceholder(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '|';
  });
}

bool IsExample(std::string_view value) { return IsPlaceholder(value) || value == "..."; }

/// Takes the front of `rest` as far as it holds.
template <typename Holds>
std::string_view TakeWhile(std::string_view& rest, Holds&& holds) {
  const auto size = static_cast<std::size_t>(std::ranges::find_if_not(rest, holds) - rest.begin());
  const std::string_view taken = rest.substr(0, size);
  rest.remove_prefix(size);
  return taken;
}

/// A value without the mark that ends its sentence.
std::string_view WithoutMark(std::string_view value, std::string_view& rest) {
  if (value.ends_with("...") || value.empty()) return value;
  const bool ends = value.back() == '.' || value.back() == ':' || value.back() == '?';
  if (!ends) return value;
  rest = {value.data() + value.size() - 1, rest.size() + 1};
  return value.substr(0, value.size() - 1);
}

/// A value as Python has it.
Tree ValueOf(std::string_view value) {
  if (const auto whole = ParseInteger(value)) return *whole;
  if (const auto number = ParseFinite(value)) return *number;
  if (value == "true" || value == "false") return value == "true";
  return std::string(value);
}

std::string Literal(std::string_view value) {
  const Tree tree = ValueOf(value);
  if (tree.is_boolean()) return tree.get<bool>() ? "True" : "False";
  if (tree.is_number() || IsPlaceholder(value)) return std::string(value);
  return fmt::format("\"{}\"", value);
}

class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}
  std::vector<Piece> Read();

 private:
  /// The option that begins here, with its value; nothing where it is none that Python has.
  std::optional<Piece> TakeOption();
  Piece TakePairs(const Spelling& spelling);
  Piece TakeSettings(const Spelling& spelling);
  Piece TakeValue(const Spelling& spelling);
  /// column=value, column=value; in quotes or not
  std::vector<std::pair<std::string, std::string>> TakeColumns();

  std::string_view rest_;
};

std::vector<std::pair<std::string, std::string>> Reader::TakeColumns() {
  std::vector<std::pair<std::string, std::string>> found;
  std::string_view rest = rest_;
  rest.remove_prefix(1);  // the blank
  const bool quoted = rest.starts_with('\'');
  if (quoted) rest.remove_prefix(1);
  while (true) {
    const std::string_view name = TakeWhile(rest, IsName);
    if (name.empty() || !rest.starts_with('=')) break;
    rest.remove_prefix(1);
    const std::string_view ends = quoted ? "',\n" : " ,;)'\n";
    std::string_view value =
        TakeWhile(rest, [&](char c) { return ends.find(c) == std::string_view::npos; });
    if (!quoted) value = WithoutMark(value, rest);
    found.emplace_back(name, value);
    rest_ = rest;
    // one more behind a comma
    if (!rest.starts_with(',')) break;
    rest.remove_prefix(1);
    TakeWhile(rest, [](char c) { return c == ' '; });
  }
  if (quoted && rest_.starts_with('\'')) rest_.remove_prefix(1);
  return found;
}

Piece Reader::TakePairs(const Spelling& spelling) {
  Piece piece{std::string(spelling.argument)};
  const auto pairs = rest_.starts_with(' ') ? TakeColumns() : decltype(TakeColumns()){};
  if (pairs.empty()) return piece;
  Tree map = Tree::object();
  std::string inside;
  for (const auto& [column, value] : pairs) {
    map[column] = ValueOf(value);
    piece.is_example = piece.is_example || IsExample(value);
    inside += fmt::format("{}\"{}\": {}", inside.empty() ? "" : ", ", column, Literal(value));
  }
  piece.text = fmt::format("{}={{{}}}", spelling.argument, inside);
  piece.arguments = {{std::string(spelling.argument), std::move(map)}};
  return piece;
}

Piece Reader::TakeSettings(const Spelling& spelling) {
  std::string_view rest = rest_;
  if (!rest.starts_with(' ')) return {std::string(spelling.argument)};
  rest.remove_prefix(1);
  const std::string_view key = TakeWhile(rest, IsName);
  if (key.empty()) return {std::string(spelling.argument)};
  if (!rest.starts_with('=')) {
    rest_ = rest;
    return {std::string(key)};
  }
  rest.remove_prefix(1);
  std::string_view value = TakeWhile(
      rest, [](char c) { return std::string_view(" ,;)'\n").find(c) == std::string_view::npos; });
  value = WithoutMark(value, rest);
  rest_ = rest;
  return {fmt::format("{}={}", key, Literal(value)),
          {{std::string(key), ValueOf(value)}},
          IsExample(value)};
}

Piece Reader::TakeValue(const Spelling& spelling) {
  const std::string argument(spelling.argument);
  if (spelling.behind == Behind::flag) return {argument + "=True", {{argument, true}}};
  std::string_view rest = rest_;
  if (!rest.starts_with(' ')) return {argument};
  rest.remove_prefix(1);
  std::string_view value = TakeWhile(rest, [](char c) {
    return std::string_view(" ,;()'\"\n").find(c) == std::string_view::npos;
  });
  value = WithoutMark(value, rest);
  const bool is_number = ParseFinite(value).has_value();
  const bool is_word =
      spelling.words.find(fmt::format(" {} ", value)) != std::string_view::npos && !value.empty();
  constexpr std::string_view others = " or and with for of in as is to beside where ";
  const bool is_name = spelling.behind == Behind::name && !value.empty() &&
                       others.find(fmt::format(" {} ", value)) == std::string_view::npos;
  if (!(is_number && spelling.behind == Behind::number) && !is_word && !is_name &&
      !IsPlaceholder(value)) {
    return {argument};
  }
  rest_ = rest;
  return {fmt::format("{}={}", argument, Literal(value)),
          {{argument, ValueOf(value)}},
          IsExample(value)};
}

std::optional<Piece> Reader::TakeOption() {
  std::string_view rest = rest_.substr(2);
  const std::string_view name = TakeWhile(rest, IsOption);
  const auto found = std::ranges::find(kSpellings, name, &Spelling::option);
  if (found == kSpellings.end()) return std::nullopt;
  rest_ = rest;
  if (found->behind == Behind::pairs) return TakePairs(*found);
  if (found->behind == Behind::settings) return TakeSettings(*found);
  return TakeValue(*found);
}

std::vector<Piece> Reader::Read() {
  std::vector<Piece> pieces{{}};
  char before = ' ';
  while (!rest_.empty()) {
    const bool begins = rest_.starts_with("--") && !IsName(before) && before != '-';
    if (auto piece = begins ? TakeOption() : std::nullopt) {
      pieces.push_back(*std::move(piece));
      pieces.emplace_back();
      before = 'x';
      continue;
    }
    before = rest_.front();
    pieces.back().text += before;
    rest_.remove_prefix(1);
  }
  return pieces;
}

/// What an exception says, with arguments in place of options, and nothing in it that a terminal acts on.
std::string Words(const std::exception& thrown) { return Printable(InPython(thrown.what())); }

/// Whether what stands between two options joins them into one call.
bool Joins(const std::vector<Piece>& pieces, std::size_t i) {
  return i > 0 && i + 1 < pieces.size() && pieces[i].text == " " &&
         !pieces[i - 1].arguments.empty() && !pieces[i + 1].arguments.empty();
}

}  // namespace

std::string InPython(std::string_view text) {
  const std::vector<Piece> pieces = Reader(text).Read();
  std::string spoken;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    spoken += Joins(pieces, i) ? ", " : pieces[i].text;
  }
  return spoken;
}

std::vector<Tree> CallsIn(std::string_view text) {
  const std::vector<Piece> pieces = Reader(text).Read();
  std::vector<Tree> calls;
  bool is_example = false;  // a part of the call that is being made
  for (std::size_t i = 1; i < pieces.size(); i += 2) {
    if (pieces[i].arguments.empty()) continue;
    if (!Joins(pieces, i - 1)) {
      if (is_example) calls.pop_back();
      calls.push_back(Tree::object());
      is_example = false;
    }
    is_example = is_example || pieces[i].is_example;
    for (const auto& [argument, value] : pieces[i].arguments) calls.back()[argument] = value;
  }
  if (is_example) calls.pop_back();
  return calls;
}

std::string PrintableText(nanobind::handle raised) {
  const nanobind::object said = nanobind::handle(PyExc_ValueError).attr("__str__")(raised);
  // halves of pairs, which UTF-8 does not hold, by their codes
  const auto bytes =
      nanobind::cast<nanobind::bytes>(said.attr("encode")("utf-8", "backslashreplace"));
  return Printable({bytes.c_str(), bytes.size()});
}

void SpeakPython(nanobind::module_ core) {
  // lives as long as the interpreter, as the translator does
  nanobind::register_exception_translator(
      [](const std::exception_ptr& thrown, void* module) {
        const nanobind::handle of_core = static_cast<PyObject*>(module);
        try {
          std::rethrow_exception(thrown);
        } catch (const BadInput& refusal) {
          PyErr_SetString(of_core.attr("BadInput").ptr(), Words(refusal).c_str());
        } catch (const OutputFailed& failure) {
          PyErr_SetString(of_core.attr("OutputFailed").ptr(), Words(failure).c_str());
        }
      },
      core.release().ptr());
}

}  // namespace warmjoint::python
