// One list of the formats of logs.
#include "models/recording/log_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "models/recording/read_recording.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(LogFormats, EachEndingIsReadOrHasARemedyInAnyLetters) {
  for (const LogFormat& format : LogFormats()) {
    std::string name = "LOG" + std::string(format.ending);
    EXPECT_EQ(FormatOf(name).ending, format.ending);
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
    EXPECT_EQ(FormatOf(name).ending, format.ending);
    switch (format.by) {
      case ReadBy::program:
        EXPECT_NO_THROW(RequireReadable(name));
        break;
      case ReadBy::converter:
        EXPECT_FALSE(format.reader.empty()) << name;
        EXPECT_THAT(test::RefusalOf([&] { RequireReadable(name); }),
                    HasSubstr("warmjoint convert " + name));
        break;
      case ReadBy::nobody:
        EXPECT_FALSE(format.remedy.empty()) << name;
        EXPECT_THAT(test::RefusalOf([&] { RequireReadable(name); }), Not(HasSubstr("convert")));
        break;
    }
  }
  EXPECT_EQ(FormatOf("log.txt").by, ReadBy::program);
  EXPECT_EQ(FormatOf("csv").ending, "");
}

TEST(LogFormats, BytesThatAreNoTextAreNamedByWhatTheyAre) {
  const std::pair<std::string, const char*> files[]{
      {std::string("\x1f\x8b\x08\x00", 4) + "rows", "end in .gz"},
      {std::string("\x89HDF\r\n\x1a\n", 8), "end in .h5"},
      {std::string("PAR1\x15\x04\x15\x10", 8), "end in .parquet"},
      {std::string("\x01\x02\x00\x03\x05", 5), "its first bytes are none of characters"}};
  for (const auto& [bytes, words] : files) {
    const TemporaryFile file("log.dat", bytes);
    EXPECT_THAT(test::RefusalOf([&] { ReadRecordingFile(file.path()); }), HasSubstr(words));
  }
  // a column may be called as the bytes of a format
  const TemporaryFile table("table.dat", "PAR1,time,position,torque\n1,0,0,1\n1,1,1,2\n1,2,3,1\n");
  EXPECT_EQ(ReadRecordingFile(table.path()).size(), 3);
}

}  // namespace
}  // namespace warmjoint
