// The formats of logs by the endings of their names: one list, by which program, converter, package and pages go.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// Who reads the files of a format.
enum class ReadBy {
  program,    // this room
  converter,  // Python's libraries: `warmjoint convert`, and the package
  nobody,     // there is a remedy
};

/// A format of logs.
struct LogFormat {
  std::string_view ending;  // of a file's name, in small letters; a name may have it in any
  std::string_view name;    // in messages, with its article
  ReadBy by = ReadBy::program;
  /// Module of tools/python/warmjoint/formats that reads it; of what the program reads, cells, compounds and structs in it.
  std::string_view reader = "";
  std::string_view remedy = "";  // where nobody reads it
  std::string_view begins =
      "";  // the bytes that such files begin with; empty: no such bytes tell it
};

/// All, longer endings before those that they end in. Any other name is that of a table of text.
const std::vector<LogFormat>& LogFormats();

/// The format of a file by its name; a table of text where no ending fits.
const LogFormat& FormatOf(const std::string& path);

/// The format that bytes begin as; nullptr for none of them.
const LogFormat* FormatOfBytes(std::string_view bytes);

/// Whether a file, by its name, or a folder is of a format that `warmjoint convert` reads and this room does not.
bool IsOtherFormat(const std::string& path);

/// Whether a file is of a format that this room reads, and may hold cells, compounds or structs, which the converter reads.
bool MayHoldObjects(const std::string& path);

/// The endings that someone reads, as ".csv, .h5, ...".
std::string EndingsOf(ReadBy by);

/// Throws BadInput for a file that this room does not read, with what helps.
void RequireReadable(const std::string& path);

}  // namespace warmjoint
