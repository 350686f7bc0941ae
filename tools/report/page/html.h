// Pieces of a web page.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/report/draw/draw_figure.h"
#include "tools/report/draw/escape.h"
#include "tools/terminal/table.h"

namespace warmjoint::report {

/// RFC 4648 base 64.
std::string Base64(std::string_view bytes);

/// A Content-Security-Policy, as a meta element, that lets a page load nothing and run nothing but these
/// texts of its own style and script elements, known by their sha256; pictures come as data.
std::string SecurityPolicy(const std::vector<std::string_view>& styles,
                           const std::vector<std::string_view>& scripts);

/// The same of a page with charts, whose library sets styles of single elements.
std::string ChartSecurityPolicy(const std::vector<std::string_view>& scripts);

/// <section> with a heading; id: its place in links.
std::string Section(const std::string& id, const std::string& heading, const std::string& body);

/// <p>, escaped.
std::string Paragraph(const std::string& text);

/// A text of the terminal as it is set in print: N·m, Cramér-Rao, µs.
std::string InPrint(std::string text);

/// A table with its caption, in print; the first column (after one of ranks, "#") heads the rows, cells with
/// numbers stand right.
std::string HtmlTable(const std::string& caption, const warmjoint::Table& table);

/// Terms and their meanings as a <dl>, escaped.
std::string HtmlTerms(const std::vector<std::pair<std::string, std::string>>& terms);

/// A figure drawn into the page, for light and for dark screens, with its alt text. PNG.
std::string HtmlPicture(const Figure& figure);

}  // namespace warmjoint::report
