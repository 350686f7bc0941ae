#include "tools/parser/man_page.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "tools/parser/exit_statuses.h"
#include "tools/parser/help.h"
#include "tools/terminal/wrap.h"

namespace warmjoint::inline tools {
namespace {

/// Words that roff shows as they are.
std::string Escaped(const std::string& words) {
  std::string text;
  // backslashes and dashes mean something to roff
  for (const char c : words) {
    if (c == '\\') {
      text += "\\e";
    } else if (c == '-') {
      text += "\\-";
    } else {
      text += c;
    }
  }

  // so does a dot or a quote at the beginning of a line
  const bool looks_like_request = !text.empty() && (text[0] == '.' || text[0] == '\'');
  return looks_like_request ? "\\&" + text : text;
}

std::string Bold(const std::string& words) { return "\\fB" + Escaped(words) + "\\fR"; }
std::string Italic(const std::string& words) { return "\\fI" + Escaped(words) + "\\fR"; }

std::string Head(const OptionNode& option) {
  if (!option.argument.empty()) return Italic(OptionHead(option));
  std::string head;
  for (const std::string& name : option.names) head += (head.empty() ? "" : ", ") + Bold(name);
  return option.takes_value() ? head + " " + Italic(option.value) : head;
}

std::string Paragraph(const std::string& head, const std::string& words) {
  return fmt::format(".TP\n{}\n{}\n", head, Escaped(words));
}

std::string Section(const std::string& name, const std::vector<OptionNode>& options) {
  if (options.empty()) return "";
  std::string text = fmt::format(".SH {}\n", name);
  for (const OptionNode& option : options) text += Paragraph(Head(option), OptionWords(option));
  return text;
}

std::string ExitStatusSection() {
  std::string text = ".SH \"EXIT STATUS\"\n";
  for (const ExitMeaning& one : ExitMeanings()) {
    text += Paragraph(Bold(std::to_string(one.status)), one.meaning);
  }
  return text;
}

std::string SeeAlso(const CommandNode& command, const std::string& program) {
  std::vector<std::string> pages;
  // the program's page from a subcommand, all subcommands' pages from the program
  if (!program.empty()) pages.push_back(Bold(program) + "(1)");
  for (const CommandNode& one : command.commands) {
    pages.push_back(Bold(ManName(one, command.name)) + "(1)");
  }
  return fmt::format(".SH \"SEE ALSO\"\n{}\n", fmt::join(pages, ",\n"));
}

}  // namespace

std::string ManName(const CommandNode& command, const std::string& program) {
  return program.empty() ? command.name : program + "-" + command.name;
}

std::string ManPage(const CommandNode& command, const std::string& program,
                    const std::string& version) {
  // the title in capitals
  const std::string name = ManName(command, program);
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string page =
      fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", Escaped(upper), version);

  // name, synopsis and what the footer says
  page += fmt::format(".SH NAME\n{} \\- {}\n", Escaped(name), Escaped(command.description));
  page += fmt::format(".SH SYNOPSIS\n{}\n", Escaped(UsageOf(command, program)));
  if (!command.footer.empty()) {
    page += ".SH DESCRIPTION\n";
    // an empty line parts paragraphs
    for (const std::string& line : Lines(command.footer)) {
      page += line.empty() ? std::string(".PP\n") : Escaped(line) + "\n";
    }
  }

  // what the command takes
  page += Section("ARGUMENTS", command.arguments);
  if (!command.commands.empty()) page += ".SH COMMANDS\n";
  for (const CommandNode& one : command.commands) {
    page += Paragraph(Bold(one.name), one.description);
  }
  return page + Section("OPTIONS", command.options) + ExitStatusSection() +
         SeeAlso(command, program);
}

}  // namespace warmjoint::inline tools
