#include "tools/report/draw/svg_file.h"

#include <fmt/core.h>

#include <cctype>
#include <map>

#include "models/foundation/excerpt.h"
#include "tools/report/draw/escape.h"

namespace warmjoint::report {
namespace {

/// As few digits as a place needs.
std::string Digits(double value) {
  std::string text = fmt::format("{:.4f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

/// Gives each "NAME<number>" a number by the order in which they come.
std::string Renumber(const std::string& svg, const std::string& name) {
  std::map<std::string, std::size_t> numbers;
  std::string result;
  std::size_t copied = 0;
  // numbers behind the name are counted anew in the order of their coming
  for (std::size_t at = 0; (at = svg.find(name, at)) != svg.npos;) {
    const std::size_t begin = at + name.size();
    std::size_t end = begin;
    while (end < svg.size() && std::isdigit(static_cast<unsigned char>(svg[end]))) ++end;
    // only names in quotes and references to them have such a number
    const bool is_name = at > 0 && (svg[at - 1] == '"' || svg[at - 1] == '#') && end > begin;
    at = end;
    if (!is_name) continue;
    const auto number = numbers.emplace(svg.substr(begin, end - begin), numbers.size() + 1).first;
    result += svg.substr(copied, begin - copied) + std::to_string(number->second);
    copied = end;
  }
  return result + svg.substr(copied);
}

/// One element for each run: lowered letters have a size and a place of their own.
std::string ElementsOf(const SvgWords& words) {
  const auto& [line, factor, x, y] = words;
  std::string elements;
  for (const Run& run : RunsOf(line.text, line.type)) {
    const double along = factor * run.left, down = factor * run.drop;
    // words that run upwards are turned about their own begin
    const double own_x = line.upwards ? x + down : x + along;
    const double own_y = line.upwards ? y - along : y + down;
    const std::string turned =
        line.upwards ? fmt::format(" transform=\"rotate(-90 {} {})\"", Digits(own_x), Digits(own_y))
                     : "";
    // viewers without the typeface keep its widths
    elements += fmt::format(
        "<text x=\"{}\" y=\"{}\"{} font-size=\"{}\"{} fill=\"#{:02x}{:02x}{:02x}\" "
        "textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\">{}</text>\n",
        Digits(own_x), Digits(own_y), turned, Digits(factor * EmOf(run.type)),
        run.type.bold ? " font-weight=\"bold\"" : "", line.colour.red, line.colour.green,
        line.colour.blue, Digits(factor * run.width), Escape(run.text));
  }
  return elements;
}

}  // namespace

std::string CompleteSvg(const std::string& drawn, const std::vector<SvgWords>& words,
                        const Description& description) {
  std::string svg = drawn;
  for (const char* name : {"surface", "image"}) svg = Renumber(svg, name);

  // title and description come first in the drawing
  const std::size_t head = svg.find('>', svg.find("<svg")) + 1;
  std::string about = "\n";
  if (!description.title.empty()) {
    about += fmt::format("<title>{}</title>\n", Escape(Printable(description.title)));
  }
  if (!description.text.empty()) {
    about += fmt::format("<desc>{}</desc>", Escape(Printable(description.text)));
  }
  // words as text behind all shapes, so that they can be found and copied
  const std::size_t end = svg.rfind("</svg>");
  std::string text = fmt::format(
      "<g font-family=\"{}, Verdana, sans-serif\" xml:space=\"preserve\">\n", kTypefaceName);
  for (const SvgWords& line : words) text += ElementsOf(line);
  return svg.substr(0, head) + about + svg.substr(head, end - head) + text + "</g>\n</svg>\n";
}

}  // namespace warmjoint::report
