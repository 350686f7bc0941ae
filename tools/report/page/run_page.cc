#include "tools/report/page/run_page.h"

#include <fmt/core.h>

#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"
#include "tools/report/page/html.h"
#include "tools/report/page/realization_list.h"
#include "tools/report/page/run_words.h"
#include "tools/report/page/style.h"

namespace warmjoint::report {
namespace {

// the run's directory, as the page calls it
constexpr const char* kRun = "RUN";

std::string About(const Suite& suite) {
  // what the suite simulates, in sentences
  std::string simulated;
  for (const std::string& sentence : WhatWasSimulated(suite)) {
    simulated += (simulated.empty() ? "" : " ") + sentence;
  }
  std::string html =
      Paragraph(
          "warmjoint finds the friction of a robot's joint, which falls as the joint warms by its "
          "own "
          "losses, in a log of position, velocity and torque. On this page several methods, the "
          "identifiers, did that on simulated logs whose true friction is known, so that their "
          "errors can be measured.") +
      Paragraph(simulated) + "<h3>The identifiers</h3>\n";
  // each identifier with what it is
  std::vector<std::pair<std::string, std::string>> identifiers;
  for (const SuiteIdentifier& one : suite.identifiers) {
    identifiers.emplace_back(one.label, WhatItIs(one));
  }
  return html + HtmlTerms(identifiers);
}

std::string Realizations(const RunPage& page) {
  const std::string extremes =
      page.extremes ? HtmlPicture(*page.extremes) : Paragraph(page.without_extremes);
  return extremes + RealizationList(page.view, page.suite, kRun);
}

std::string Pictures(const std::vector<Figure>& figures) {
  std::string html;
  for (const Figure& figure : figures) html += HtmlPicture(figure);
  return html;
}

std::string Leaderboards(const Leaderboard& board) {
  std::string html = HtmlTable("Who wins: normalised parameter error, NPE", RankingTable(board)) +
                     HtmlTable("Agreement with the data, medians", AgreementTable(board));
  // variants beside each other, where there are some
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
  for (const std::string& note : Notes(board)) html += "<li>" + Escape(InPrint(note)) + "</li>\n";
  return html.empty() ? Paragraph("Every identifier answered every realization.")
                      : "<ul>\n" + html + "</ul>\n";
}

std::string HowToRepeat(const Leaderboard& board, const RunDescription& description) {
  std::string html = Paragraph("Save the suite below as suite.yaml, then:");
  html += fmt::format("<pre>warmjoint run suite.yaml -o {0}\nwarmjoint report {0}</pre>\n", kRun);
  // how to make the log of one row again
  html += Paragraph(
      "One realization alone, as its row above says, leaves its recording in `replay`; an "
      "identifier "
      "takes that:");
  html += "<pre>warmjoint identify replay/recording.csv --identifier NAME</pre>\n";
  // how far the run came, and with which versions
  html += Paragraph(fmt::format("{} of {} realizations are finished. Made with:", board.finished,
                                board.realizations));
  html += "<ul>\n";
  for (const auto& [name, version] : description.versions) {
    html += fmt::format("<li>{} {}</li>\n", Escape(name), Escape(version));
  }
  // the suite itself, to be saved
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
  const Leaderboard& board = page.view.board;
  struct Part {
    const char* id;
    const char* heading;
    std::string body;
  };
  // parts in the order of a reader's questions
  const Part parts[] = {{"about", "What this is", About(page.suite)},
                        {"leaderboard", "Leaderboard", Leaderboards(board)},
                        {"realizations", "Realizations", Realizations(page)},
                        {"pictures", "Pictures", Pictures(page.figures)},
                        {"failures", "Failures and notes", NotesOf(board)},
                        {"terms", "Terms", HtmlTerms(RunTerms())},
                        {"repeat", "How to repeat it", HowToRepeat(board, page.description)}};
  // a link to each part in front of them all
  std::string links, body;
  for (const Part& part : parts) {
    links += fmt::format("<li><a href=\"#{}\">{}</a></li>", part.id, part.heading);
    body += Section(part.id, part.heading, part.body);
  }
  const std::string own_style(RealizationStyle());
  // head with verdict and links, then the parts, then the numbers for machines
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{}"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
             "<link rel=\"icon\" href=\"data:,\">\n<title>{} – "
             "warmjoint</title>\n<style>{}</style>\n"
             "<style>{}</style>\n</head>\n<body>\n<a class=\"skip\" href=\"#leaderboard\">Skip to "
             "the "
             "leaderboard</a>\n<header>\n<h1>{}</h1>\n<p class=\"question\">{}</p>\n<p "
             "class=\"verdict\">{}</p>\n<nav aria-label=\"On this page\"><ul>{}</ul></nav>\n"
             "</header>\n<main>\n",
             SecurityPolicy({kStyle, own_style}, {RealizationScript()}), Escape(board.suite),
             kStyle, own_style, Escape(board.suite), Escape(board.question),
             Escape(InPrint(Verdict(board))), links) +
         body + "</main>\n" + DataBlock(board) + "<script>" + std::string(RealizationScript()) +
         "</script>\n</body>\n</html>\n";
}

}  // namespace warmjoint::report
