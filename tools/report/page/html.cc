#include "tools/report/page/html.h"

#include <fmt/core.h>

#include <cstdint>

#include "models/foundation/sha256.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint::report {
namespace {

/// The column that names the rows: a first one of ranks does not.
std::size_t HeadColumn(const warmjoint::Table& table) {
  return !table.header.empty() && table.header[0] == "#" ? 1 : 0;
}

/// The head of a row; rows that leave it out belong to the one above.
std::string HeadOf(const warmjoint::Table& table, std::size_t row) {
  const std::size_t column = HeadColumn(table);
  while (row > 0 && table.rows[row][column].empty()) --row;
  return table.rows[row][column];
}

/// Names of columns stand left where their cells are words.
bool IsWords(const warmjoint::Table& table, std::size_t column) {
  for (const auto& row : table.rows) {
    const char first = row[column].empty() ? '-' : row[column].front();
    if (!(first >= '0' && first <= '9') && first != '-') return true;
  }
  return false;
}

/// Cells of words stand left; the column that names the rows stays in sight when a table scrolls.
std::string ClassOf(const warmjoint::Table& table, std::size_t column) {
  std::string classes = column == HeadColumn(table) ? "name" : "";
  if (IsWords(table, column)) classes += classes.empty() ? "words" : " words";
  return classes.empty() ? "" : fmt::format(" class=\"{}\"", classes);
}

/// "'sha256-...'" of each text, or 'none'.
std::string Hashes(const std::vector<std::string_view>& texts) {
  std::string hashes;
  for (const std::string_view text : texts) {
    // the bytes that the hexadecimal digits stand for
    const std::string digits = Sha256(text);
    std::string bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2) {
      bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
    }
    hashes += fmt::format(" 'sha256-{}'", Base64(bytes));
  }
  return hashes.empty() ? " 'none'" : hashes;
}

std::string Policy(const std::string& styles, const std::string& scripts) {
  return fmt::format(
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src{}; script-src{}; base-uri 'none'; form-action 'none'\">\n",
      styles, scripts);
}

std::string DataUrl(std::string_view png) { return "data:image/png;base64," + Base64(png); }

}  // namespace

std::string SecurityPolicy(const std::vector<std::string_view>& styles,
                           const std::vector<std::string_view>& scripts) {
  return Policy(Hashes(styles), Hashes(scripts));
}

std::string ChartSecurityPolicy(const std::vector<std::string_view>& scripts) {
  return Policy(" 'unsafe-inline'", Hashes(scripts));
}

std::string Base64(std::string_view bytes) {
  static constexpr char kLetters[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const auto byte = [&](std::size_t k) {
      return k < left ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k])) : 0u;
    };
    // three bytes make four letters
    const std::uint32_t group = byte(0) << 16 | byte(1) << 8 | byte(2);
    text += kLetters[group >> 18 & 63];
    text += kLetters[group >> 12 & 63];
    // bytes that the last group lacks are written as =
    text += left > 1 ? kLetters[group >> 6 & 63] : '=';
    text += left > 2 ? kLetters[group & 63] : '=';
  }
  return text;
}

std::string Section(const std::string& id, const std::string& heading, const std::string& body) {
  return fmt::format(
      "<section id=\"{0}\" aria-labelledby=\"{0}-h\">\n<h2 id=\"{0}-h\">{1}</h2>\n{2}</section>\n",
      id, Escape(heading), body);
}

std::string Paragraph(const std::string& text) { return "<p>" + Escape(text) + "</p>\n"; }

std::string InPrint(std::string text) {
  static constexpr std::pair<const char*, const char*> kPrint[] = {
      {"N.m", "N·m"}, {")^2", ")²"}, {"Cramer-Rao", "Cramér-Rao"}};
  for (const auto& [typed, printed] : kPrint) text = Replaced(std::move(text), typed, printed);
  if (text.ends_with(" us")) text.replace(text.size() - 2, 1, "µ");
  return text;
}

std::string HtmlTable(const std::string& caption, const warmjoint::Table& table) {
  // wide tables scroll by themselves, with the keyboard too
  std::string html = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\">\n<table>\n"
      "<caption>{0}</caption>\n<thead><tr>",
      Escape(caption));
  // headings of the columns
  for (std::size_t i = 0; i < table.header.size(); ++i) {
    html += fmt::format("<th scope=\"col\"{}>{}</th>", ClassOf(table, i),
                        Escape(InPrint(table.header[i])));
  }
  html += "</tr></thead>\n<tbody>\n";
  // each row has one cell that names it
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    html += "<tr>";
    for (std::size_t i = 0; i < table.rows[row].size(); ++i) {
      // numbers stand at the right, words at the left
      const std::string kind = ClassOf(table, i);
      html += i == HeadColumn(table)
                  ? fmt::format("<th scope=\"row\"{}>{}</th>", kind,
                                Escape(InPrint(HeadOf(table, row))))
                  : fmt::format("<td{}>{}</td>", kind, Escape(InPrint(table.rows[row][i])));
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n</div>\n";
}

std::string HtmlTerms(const std::vector<std::pair<std::string, std::string>>& terms) {
  std::string html = "<dl>\n";
  for (const auto& [term, meaning] : terms) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", Escape(term), Escape(meaning));
  }
  return html + "</dl>\n";
}

std::string HtmlPicture(const Figure& figure) {
  PageSetting setting;
  // drawn twice: the reader's screen takes the light or the dark one
  const PictureFile light = EncodeFigure(figure, setting);
  setting.style = StyleNamed("dark");
  const PictureFile dark = EncodeFigure(figure, setting);
  return fmt::format(
      "<figure id=\"{0}\">\n"
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{6}\">\n<picture>\n"
      "<source media=\"(prefers-color-scheme: dark)\" srcset=\"{1}\">\n"
      "<img src=\"{2}\" width=\"{3:.0f}\" height=\"{4:.0f}\" alt=\"{5}\">\n</picture>\n</div>\n"
      "<figcaption>{7}</figcaption>\n</figure>\n",
      Escape(figure.name), DataUrl(dark.bytes), DataUrl(light.bytes), light.width, light.height,
      Escape(figure.title + ". " + figure.finding), Escape(figure.title), Escape(light.caption));
}

}  // namespace warmjoint::report
