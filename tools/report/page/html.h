// Pieces of a web page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/board/table.h"
#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// Text with the characters that HTML reads as its own replaced: & < > " '.
std::string Escape(std::string_view text);

/// RFC 4648 base 64.
std::string Base64(std::string_view bytes);

/// A Content-Security-Policy, as a meta element, that lets a page load nothing and run nothing but these
/// texts of its own style and script elements, known by their sha256; pictures come as data.
std::string SecurityPolicy(const std::vector<std::string_view>& styles,
                           const std::vector<std::string_view>& scripts);

/// <section> with a heading; id: its place in links.
std::string Section(const std::string& id, const std::string& heading, const std::string& body);

/// <p>, escaped.
std::string Paragraph(const std::string& text);

/// A table with its caption; the first column (after one of ranks, "#") heads the rows, cells with
/// numbers stand right.
std::string HtmlTable(const std::string& caption, const warmjoint::Table& table);

/// A picture inside the page, for light and for dark screens, with its alt text. PNG bytes.
std::string HtmlPicture(const Figure& figure, std::string_view light, std::string_view dark);

}  // namespace warmjoint::report
