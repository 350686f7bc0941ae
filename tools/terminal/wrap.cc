#include "tools/terminal/wrap.h"

#include <algorithm>

#include "models/foundation/excerpt.h"

namespace warmjoint::inline tools {
namespace {

/// Number of bytes of an escape sequence of colour at the beginning; 0 where there is none.
std::size_t ColourBytes(std::string_view text) {
  if (!text.starts_with("\033[")) return 0;
  const std::size_t end = text.find('m');
  return end == std::string_view::npos ? 0 : end + 1;
}

/// Number of bytes of the first character.
std::size_t CharacterBytes(std::string_view text) {
  return std::max<std::size_t>(1, FirstCharacter(text).length);
}

std::string Blanks(int number) { return std::string(static_cast<std::size_t>(number), ' '); }

/// The part of `text` before its next blank, which is taken off, with the blank.
std::string_view TakeWord(std::string_view& text) {
  const std::size_t end = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

}  // namespace

int ShownWidth(std::string_view text) {
  // colours take no columns, other characters one each
  int width = 0;
  while (!text.empty()) {
    const std::size_t colour = ColourBytes(text);
    if (colour == 0) ++width;
    text.remove_prefix(colour > 0 ? colour : CharacterBytes(text));
  }
  return width;
}

std::vector<std::string> WrapLine(std::string_view text, int width) {
  // the text keeps its own indentation
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  std::vector<std::string> lines;
  std::string line(text.substr(0, begin));
  text.remove_prefix(begin);
  int used = static_cast<int>(begin);
  bool fresh = true;

  // word by word; one that does not fit begins a line, however long it is
  while (!text.empty()) {
    const std::string_view word = TakeWord(text);
    const int wide = ShownWidth(word);
    if (!fresh && used + 1 + wide > width) {
      lines.push_back(std::move(line));
      line.clear();
      used = 0;
      fresh = true;
    }
    // a blank parts it from the word before
    if (!fresh) line += ' ';
    used += wide + (fresh ? 0 : 1);
    line += word;
    fresh = false;
  }
  lines.push_back(std::move(line));
  return lines;
}

std::string Wrap(std::string_view text, int width, int hanging) {
  std::string wrapped;
  // each line of the text by itself, with its line break
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    const std::string_view stop = text.substr(end, 1);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (ShownWidth(line) <= width) {
      wrapped.append(line).append(stop);
      continue;
    }

    // the first line has its own beginning, the others stand further in
    const int own = static_cast<int>(std::min(line.find_first_not_of(' '), line.size()));
    const int room = std::max(1, width - own - hanging);
    // the rest stands further in, and has so much less room
    std::vector<std::string> first = WrapLine(line, width);
    wrapped += first.front();
    const std::size_t taken = std::min(first.front().size() + 1, line.size());
    if (taken < line.size()) {
      for (const std::string& next : WrapLine(line.substr(taken), room)) {
        wrapped += "\n" + Blanks(own + hanging) + next;
      }
    }
    wrapped += stop;
  }
  return wrapped;
}

std::vector<std::string> Lines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    // a line break at the end begins no further line
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string CutToWidth(std::string_view text, int width) {
  if (ShownWidth(text) <= width) return std::string(text);
  // three dots stand for what is cut off, where there is room for them
  const int kept = std::max(0, width - 3);
  const std::string dots(static_cast<std::size_t>(std::min(3, std::max(0, width))), '.');
  std::string cut;
  // colours stay, those behind the cut too, so that what was begun ends
  for (int used = 0; !text.empty();) {
    const std::size_t colour = ColourBytes(text);
    const std::size_t bytes = colour > 0 ? colour : CharacterBytes(text);
    if (colour == 0 && used++ == kept) cut += dots;
    if (colour > 0 || used <= kept) cut += text.substr(0, bytes);
    text.remove_prefix(bytes);
  }
  return cut;
}

}  // namespace warmjoint::inline tools
