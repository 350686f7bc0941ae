#include "tools/report/page/chart_library.h"

#include "tools/report/draw/embed.h"

WARMJOINT_EMBED(warmjoint_chart_script, WARMJOINT_CHART_SCRIPT)
WARMJOINT_EMBED(warmjoint_chart_style, WARMJOINT_CHART_STYLE)
WARMJOINT_EMBED(warmjoint_chart_licence, WARMJOINT_CHART_LICENCE)

namespace warmjoint::report {
namespace {

std::string_view Between(const unsigned char* begin, const unsigned char* end) {
  return {reinterpret_cast<const char*>(begin), static_cast<std::size_t>(end - begin)};
}

/// Without the last line, which names a file for debuggers: the page asks for nothing.
std::string_view WithoutMap(std::string_view text) {
  const std::size_t mark = text.rfind("# sourceMappingURL");
  return mark == text.npos ? text : text.substr(0, text.rfind('\n', mark));
}

}  // namespace

std::string_view ChartScript() {
  static const std::string_view script =
      WithoutMap(Between(warmjoint_chart_script_begin, warmjoint_chart_script_end));
  return script;
}

std::string_view ChartStyle() {
  static const std::string_view style =
      WithoutMap(Between(warmjoint_chart_style_begin, warmjoint_chart_style_end));
  return style;
}

std::string_view ChartLicence() {
  return Between(warmjoint_chart_licence_begin, warmjoint_chart_licence_end);
}

}  // namespace warmjoint::report
