// The numbers of wj_friction with their names, units and intervals, as all spellings of it have them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/export/engine_friction.h"

namespace warmjoint {

/// A number of wj_friction with its parameter's unit and interval.
struct CodeLine {
  const char* member;
  double value;
  std::string_view unit;
  std::string parameter{};  // in an estimate; empty: the member's name
};

/// All of them, in the order of the header. numbers: of CompensatorNumbers of the friction.
std::vector<CodeLine> AllCodeLines(const SeenFriction& seen, const wj_friction& numbers);

/// Those that are not 0.
std::vector<CodeLine> CodeLinesOf(const SeenFriction& seen, const wj_friction& numbers);

/// "4.99 .. 5.01 N.m", or the unit alone, which may be empty.
std::string SaidOf(const CodeLine& line, const SeenFriction& seen);

/// The same as a comment behind a number; empty where there is nothing to say. begin: "//" or "#".
std::string CommentOf(const CodeLine& line, const SeenFriction& seen, std::string_view begin);

/// All digits, as a number with a point, which YAML and C read as one.
std::string Literal(double value);

/// What a joint is called in code. Two joints may get the same.
std::string CodeName(const std::string& joint);

/// What of a friction steady sliding leaves out, the end of a comment; mostly empty.
std::string LeftOutOf(const Friction& friction);

}  // namespace warmjoint
