#include "tools/report/page/run_page.h"

#include <fmt/core.h>

#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"
#include "tools/report/draw/draw_figure.h"
#include "tools/report/page/html.h"
#include "tools/report/page/style.h"

namespace warmjoint::report {
namespace {

std::string Pictures(const std::vector<Figure>& figures) {
  std::string html;
  PageSetting light, dark;
  dark.style = StyleNamed("dark");
  for (const Figure& figure : figures) {
    html += HtmlPicture(figure, EncodeFigure(figure, light), EncodeFigure(figure, dark));
  }
  return html;
}

std::string Leaderboards(const Leaderboard& board) {
  std::string html = HtmlTable("Who wins: normalised parameter error, NPE", RankingTable(board)) +
                     HtmlTable("Agreement with the data, medians", AgreementTable(board));
  if (board.groups.size() > 1) {
    html += HtmlTable("Median NPE in each variant, beside its bound", GroupTable(board));
  }
  const warmjoint::Table parameters = ParameterTable(board);
  if (!parameters.rows.empty()) {
    html += HtmlTable("Each parameter beside its Cramér-Rao bound", parameters);
  }
  return html;
}

std::string NotesOf(const Leaderboard& board) {
  std::string html;
  for (const std::string& note : Notes(board)) html += "<li>" + Escape(note) + "</li>\n";
  return html.empty() ? Paragraph("Every identifier answered every realization.")
                      : "<ul>\n" + html + "</ul>\n";
}

std::string HowToRepeat(const Leaderboard& board, const RunDescription& description) {
  std::string html = Paragraph("Save the suite below as suite.yaml, then:");
  html += "<pre>warmjoint run suite.yaml -o RUN\nwarmjoint report RUN</pre>\n";
  html += Paragraph(fmt::format("{} of {} realizations are finished. Made with:", board.finished,
                                board.realizations));
  html += "<ul>\n";
  for (const auto& [name, version] : description.versions) {
    html += fmt::format("<li>{} {}</li>\n", Escape(name), Escape(version));
  }
  html += "</ul>\n<details><summary>suite.yaml</summary>\n<pre>" + Escape(description.suite_yaml) +
          "</pre>\n</details>\n";
  return html;
}

/// The leaderboard for programs; "<" cannot end the block early.
std::string DataBlock(const Leaderboard& board) {
  std::string json = BoardToJson(board);
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += 6) {
    json.replace(at, 1, "\\u003c");
  }
  return "<script type=\"application/json\" id=\"board\">" + json + "</script>\n";
}

}  // namespace

std::string MakeRunPage(const RunPage& page) {
  const Leaderboard& board = page.board;
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{}"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{} – warmjoint</title>\n<style>{}</style>\n"
      "</head>\n<body>\n<a class=\"skip\" href=\"#leaderboard\">Skip to the leaderboard</a>\n"
      "<header>\n<h1>{}</h1>\n<p class=\"question\">{}</p>\n<p class=\"verdict\">{}</p>\n"
      "<nav aria-label=\"On this page\"><ul><li><a href=\"#leaderboard\">Leaderboard</a></li>"
      "<li><a href=\"#pictures\">Pictures</a></li><li><a href=\"#failures\">Failures and notes</a>"
      "</li><li><a href=\"#repeat\">How to repeat it</a></li></ul></nav>\n</header>\n<main>\n",
      SecurityPolicy({kStyle}, {}), Escape(board.suite), kStyle, Escape(board.suite),
      Escape(board.question), Escape(Verdict(board)));
  html += Section("leaderboard", "Leaderboard", Leaderboards(board));
  html += Section("pictures", "Pictures", Pictures(page.figures));
  html += Section("failures", "Failures and notes", NotesOf(board));
  html += Section("repeat", "How to repeat it", HowToRepeat(board, page.description));
  return html + "</main>\n" + DataBlock(board) + "</body>\n</html>\n";
}

}  // namespace warmjoint::report
