#include <gmock/gmock.h>
#include <matio.h>

#include <Eigen/Core>
#include <cstdint>
#include <numbers>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/recording/read_recording.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

const std::vector<double> kTime{0, 0.1, 0.2, 0.3, 0.4};
const std::vector<double> kPosition{0, 1.0 / 3, 0.5, 0.25, 0.125};
const std::vector<double> kTorque{-1, 1, -1, 1.5, 2};

matvar_t* Text(const char* name, std::string text) {
  size_t size[2]{1, text.size()};
  return Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, size, text.data(), 0);
}

template <typename Number = double>
matvar_t* Vector(const char* name, std::vector<Number> values, matio_classes kind = MAT_C_DOUBLE,
                 matio_types type = MAT_T_DOUBLE) {
  size_t size[2]{values.size(), 1};
  return Mat_VarCreate(name, kind, type, 2, size, values.data(), 0);
}

matvar_t* Struct(const char* name, std::vector<const char*> names,
                 const std::vector<matvar_t*>& fields) {
  size_t size[2]{1, 1};
  matvar_t* made =
      Mat_VarCreateStruct(name, 2, size, names.data(), static_cast<unsigned>(names.size()));
  for (size_t i = 0; i < names.size(); ++i) {
    Mat_VarSetStructFieldByName(made, names[i], 0, fields[i]);
  }
  return made;
}

/// How a file is written.
struct Form {
  mat_ft version = MAT_FT_MAT5;
  matio_compression compression = MAT_COMPRESSION_NONE;
};

/// Writes the variables, and frees them.
void Write(const std::string& path, const std::vector<matvar_t*>& variables, Form form = {}) {
  mat_t* const file = Mat_CreateVer(path.c_str(), nullptr, form.version);
  ASSERT_NE(file, nullptr);
  for (matvar_t* variable : variables) {
    EXPECT_EQ(Mat_VarWrite(file, variable, form.compression), 0);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

std::vector<matvar_t*> Columns() {
  return {Vector("time", kTime), Vector("position", kPosition), Vector("torque", kTorque)};
}

std::vector<double> Values(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

std::string Refusal(const std::string& path, const ReadSettings& layout = {}) {
  return test::RefusalOf([&] { ReadRecordingFile(path, layout); });
}

TEST(Matlab, ReadsEveryVersionBitForBit) {
  const std::vector<Form> forms{{MAT_FT_MAT4},
                                {MAT_FT_MAT5},
                                {MAT_FT_MAT5, MAT_COMPRESSION_ZLIB},
                                {MAT_FT_MAT73},
                                {MAT_FT_MAT73, MAT_COMPRESSION_ZLIB}};
  for (const Form& form : forms) {
    const TemporaryFile file("log.mat");
    Write(file.path(), Columns(), form);
    const Measurements log = ReadRecordingFile(file.path());
    EXPECT_EQ(Values(log.time), kTime) << form.version;
    EXPECT_EQ(Values(log.position), kPosition);
    EXPECT_EQ(Values(log.torque), kTorque);
  }
}

TEST(Matlab, TakesNumbersOfEveryKind) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const TemporaryFile file("log.mat");
    Write(file.path(),
          {Vector("time", kTime),
           Vector<std::int16_t>("position", {0, 3, -5, 2, 1}, MAT_C_INT16, MAT_T_INT16),
           Vector<float>("torque", {-1, 1, -1, 1.5F, 2}, MAT_C_SINGLE, MAT_T_SINGLE),
           Vector<std::uint8_t>("load", {1, 2, 3, 4, 255}, MAT_C_UINT8, MAT_T_UINT8)},
          {version});
    const Measurements log = ReadRecordingFile(file.path());
    EXPECT_EQ(Values(log.position), (std::vector<double>{0, 3, -5, 2, 1}));
    EXPECT_EQ(Values(log.torque), kTorque);
    EXPECT_EQ(Values(*log.load), (std::vector<double>{1, 2, 3, 4, 255}));
  }
}

TEST(Matlab, ReadsStructsAndWhatTheFileSaysOfItself) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const TemporaryFile file("log.mat");
    // one struct alone: its name may be left out
    const auto fields = [] { return std::vector<const char*>{"time", "position", "torque"}; };
    Write(file.path(),
          {Struct("log", fields(), Columns()), Text("joint", "rotary"), Vector("gear", {50.0}),
           Struct("unit", {"position"}, {Text("position", "deg")})},
          {version});
    const Measurements log = ReadRecordingFile(file.path());
    EXPECT_EQ(Values(log.time), kTime);
    EXPECT_DOUBLE_EQ(log.position[2], 0.5 * std::numbers::pi / 180);
    EXPECT_EQ(log.gear, 50);

    // beside another vector: by struct and field
    Write(file.path(), {Struct("log", fields(), Columns()), Vector("other", kTime)}, {version});
    EXPECT_THAT(Refusal(file.path()), HasSubstr("log.time"));
    ReadSettings layout;
    layout.map = {{"time", "log.time"}, {"position", "log.position"}, {"torque", "log.torque"}};
    EXPECT_EQ(Values(ReadRecordingFile(file.path(), layout).torque), kTorque);
  }
}

TEST(Matlab, RefusesWhatIsNoLog) {
  const TemporaryFile file("log.mat", "time,position,torque\n0,1,2\n");
  EXPECT_THAT(Refusal(file.path()), HasSubstr("cannot be read as a MATLAB file"));
  EXPECT_THAT(Refusal("there/is/none.mat"), HasSubstr("none.mat"));

  // a scalar is no column, and a matrix is one by an index alone
  size_t size[2]{2, 3};
  std::vector<double> matrix(6, 1.0);
  Write(file.path(), {Vector("time", kTime), Vector("position", kPosition), Vector("torque", {1.0}),
                      Mat_VarCreate("m", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, matrix.data(), 0)});
  EXPECT_THAT(
      Refusal(file.path()),
      HasSubstr("has no column 'torque'; it has: time (5 x 1), position (5 x 1), m (2 x 3)"));

  std::vector<matvar_t*> columns = Columns();
  columns.push_back(Vector("load", {1.0, 2.0}));
  Write(file.path(), columns);
  EXPECT_THAT(Refusal(file.path()), HasSubstr("load has 2 samples where time has 5"));
}

TEST(Matlab, RefusesFilesThatAreCutOrChanged) {
  for (const Form& form :
       std::vector<Form>{{MAT_FT_MAT5}, {MAT_FT_MAT5, MAT_COMPRESSION_ZLIB}, {MAT_FT_MAT73}}) {
    const TemporaryFile file("log.mat");
    Write(file.path(), Columns(), form);
    const std::string whole = ReadWholeFile(file.path());

    // either refused by name, or read as some numbers: never a crash of this process
    const auto try_bytes = [&](const std::string& bytes) {
      WriteWholeFile(file.path(), bytes);
      const std::string refusal = Refusal(file.path());
      if (refusal == "accepted") return;
      EXPECT_THAT(refusal, HasSubstr("log.mat"));
    };
    const size_t step = 1 + whole.size() / 40;
    for (size_t size = 0; size < whole.size(); size += step) try_bytes(whole.substr(0, size));
    for (size_t at = 0; at < whole.size(); at += step) {
      std::string changed = whole;
      changed[at] = static_cast<char>(~changed[at]);
      try_bytes(changed);
    }
  }
}

TEST(Matlab, NamesTheConverterForOtherFormats) {
  EXPECT_THAT(Refusal("log.mcap"), HasSubstr("warmjoint convert log.mcap -o log.h5"));
}

}  // namespace
}  // namespace warmjoint
