#include "tools/report/draw/typeface.h"

#include <cairo-ft.h>

#include <algorithm>
#include <cassert>
#include <span>
#include <string_view>

#include "models/foundation/excerpt.h"
#include "tools/report/draw/fonts.h"

namespace warmjoint::report {
namespace {

// of DejaVu Sans, in ems: from the highest to the lowest letter, and from the highest to the baseline
constexpr double kLine = 2384.0 / 2048, kAscent = 1901.0 / 2048;
constexpr double kLowered = 0.72;  // size of lowered letters, of the line's
constexpr double kDrop = 0.16;     // how far they are lowered, of the line's size

/// One weight of the typeface at one size for measuring: widths are proportional to the size.
class Weight {
 public:
  static constexpr double kSize = 1000;

  explicit Weight(std::span<const unsigned char> file) {
    // the typeface comes from memory, so that pictures look the same on every machine
    [[maybe_unused]] FT_Error error = FT_Init_FreeType(&library_);
    assert(!error);
    error = FT_New_Memory_Face(library_, file.data(), static_cast<FT_Long>(file.size()), 0, &face_);
    assert(!error);
    cairo_ = cairo_ft_font_face_create_for_ft_face(face_, FT_LOAD_NO_HINTING);
    // widths are measured at a large size and without rounding to pixels
    cairo_matrix_t size, level;
    cairo_matrix_init_scale(&size, kSize, kSize);
    cairo_matrix_init_identity(&level);
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    scaled_ = cairo_scaled_font_create(cairo_, &size, &level, options);
    cairo_font_options_destroy(options);
  }

  cairo_font_face_t* cairo() const { return cairo_; }
  bool Has(char32_t character) const { return FT_Get_Char_Index(face_, character) != 0; }
  /// Width of words, ems.
  double Width(const std::string& text) const {
    cairo_text_extents_t extents;
    cairo_scaled_font_text_extents(scaled_, text.c_str(), &extents);
    return extents.x_advance / kSize;
  }

 private:
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
  cairo_font_face_t* cairo_ = nullptr;
  cairo_scaled_font_t* scaled_ = nullptr;
};

/// Kept for the life of the program, since cairo keeps what it once drew with.
const Weight& WeightOf(const Type& type) {
  static const auto* regular = new Weight(RegularFont());
  static const auto* bold = new Weight(BoldFont());
  return type.bold ? *bold : *regular;
}

double WidthOf(const std::string& line, const Type& type) {
  const std::vector<Run> runs = RunsOf(line, type);
  return runs.empty() ? 0 : runs.back().left + runs.back().width;
}

/// How many bytes of `text` fit into the width, at least one character.
std::size_t FittingBytes(const std::string& text, const Type& type, double width) {
  std::size_t fits = 0;
  for (std::size_t end = 0; end < text.size(); fits = end) {
    end += std::max<std::size_t>(1, FirstCharacter(std::string_view(text).substr(end)).length);
    if (fits > 0 && WidthOf(text.substr(0, end), type) > width) break;
  }
  return fits;
}

/// Breaks one line between its words.
void BreakLine(const std::string& line, const Type& type, double wrap,
               std::vector<std::string>& lines) {
  std::string filled;
  // words fill a line as long as they fit
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    std::string word = line.substr(at, end - at);
    at = end + 1;
    const std::string longer = filled.empty() ? word : filled + ' ' + word;
    if (WidthOf(longer, type) <= wrap) {
      filled = longer;
      continue;
    }
    // what does not fit begins a new line, cut where it is longer than one
    if (!filled.empty()) lines.push_back(filled);
    while (WidthOf(word, type) > wrap) {
      const std::size_t fits = FittingBytes(word, type, wrap);
      if (fits == word.size()) break;
      lines.push_back(word.substr(0, fits));
      word.erase(0, fits);
    }
    filled = word;
  }
  lines.push_back(filled);
}

}  // namespace

double EmOf(const Type& type) { return type.size / kLine; }

double BaselineOf(const Type& type) { return kAscent * EmOf(type); }

std::vector<Run> RunsOf(const std::string& line, const Type& type) {
  std::vector<Run> runs;
  double left = 0;
  // each run begins where the one before ends
  const auto add = [&](const std::string& part, const Type& own, double drop) {
    if (part.empty()) return;
    const std::string text = Printable(part);
    const double width = EmOf(own) * WeightOf(own).Width(text);
    runs.push_back({text, own, left, width, drop});
    left += width;
  };
  const Type lowered{kLowered * type.size, type.bold};
  // what stands in _{} is set lower and smaller
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t open = line.find("_{", at);
    const std::size_t close = open == line.npos ? line.npos : line.find('}', open);
    if (close == line.npos) {
      add(line.substr(at), type, 0);
      break;
    }
    // what stands before the index as usual, the index itself lowered
    add(line.substr(at, open - at), type, 0);
    add(line.substr(open + 2, close - open - 2), lowered, kDrop * type.size);
    at = close + 1;
  }
  return runs;
}

std::vector<std::string> LinesOf(const std::string& text, const Type& type, double wrap) {
  std::vector<std::string> lines;
  // lines as the text has them, broken further where there is a width
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    if (wrap > 0) {
      BreakLine(line, type, wrap, lines);
    } else {
      lines.push_back(line);
    }
    at = end + 1;
  }
  return lines;
}

Extent Measure(const std::string& text, const Type& type, double wrap) {
  Extent extent;
  for (const std::string& line : LinesOf(text, type, wrap)) {
    extent.width = std::max(extent.width, WidthOf(line, type));
    extent.height += type.size;
  }
  return extent;
}

bool CanSet(const std::string& text, const Type& type) {
  for (std::string_view rest = text; !rest.empty();) {
    const Character character = FirstCharacter(rest);
    const bool known =
        character.length > 0 && (character.code == '\n' || WeightOf(type).Has(character.code));
    if (!known) return false;
    rest.remove_prefix(character.length);
  }
  return true;
}

cairo_font_face_t* FaceOf(const Type& type) { return WeightOf(type).cairo(); }

}  // namespace warmjoint::report
