#include <fcntl.h>
#include <gmock/gmock.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/recording/read_recording.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/support/folders.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Measurements Example() {
  Measurements log;
  log.joint = JointKind::linear;
  log.torque_unit = "A";
  log.gear = 2500;
  log.time = Eigen::Vector4d(0, 0.1, 0.2, 0.3);
  log.position = Eigen::Vector4d(0, 1.0 / 3, 0.5, 1e-320);
  log.velocity = Eigen::Vector4d(1, 2, 3, 4);
  log.torque = Eigen::Vector4d(-1, 1, -1, 1.5);
  log.load = Eigen::Vector4d(9, 8, 7, 6);
  return log;
}

std::string Refusal(const std::string& path, const ReadSettings& layout = {}) {
  return test::RefusalOf([&] { ReadRecordingFile(path, layout); });
}

TEST(Hdf5, ReadsBackBitForBitWithUnitsAndGear) {
  const Measurements log = Example();
  const TemporaryFile file("log.h5");
  WriteRecording(log, file.path());
  const Measurements copy = ReadRecordingFile(file.path());
  EXPECT_EQ(copy.joint, JointKind::linear);
  EXPECT_EQ(copy.torque_unit, "A");
  EXPECT_EQ(copy.gear, 2500);
  EXPECT_EQ(copy.time, log.time);
  EXPECT_EQ(copy.position, log.position);
  EXPECT_EQ(copy.velocity, log.velocity);
  EXPECT_EQ(copy.torque, log.torque);
  EXPECT_EQ(copy.load, log.load);
  EXPECT_FALSE(copy.temperature || copy.motor_position);
}

TEST(Hdf5, MapsColumnsAsCsvDoes) {
  const TemporaryFile file("log.h5");
  WriteRecording(Example(), file.path());
  ReadSettings layout;
  layout.joint = JointKind::linear;
  layout.map = {{"torque", "load"}};
  layout.unit = {{"position", "mm"}};
  const Measurements log = ReadRecordingFile(file.path(), layout);
  EXPECT_EQ(log.torque, *Example().load);
  EXPECT_EQ(log.torque_unit, "N") << "the unit that the mapped column has";
  EXPECT_DOUBLE_EQ(log.position[2], 0.5e-3);

  layout.map = {{"torque", "loads"}};
  EXPECT_THAT(Refusal(file.path(), layout), HasSubstr("did you mean 'load'?"));
}

TEST(Hdf5, RefusesWhatCsvRefuses) {
  Measurements log = Example();
  const TemporaryFile file("log.h5");
  log.time[2] = 0.1;
  WriteRecording(log, file.path());
  EXPECT_THAT(Refusal(file.path()),
              HasSubstr("time 0.1 s of sample 3 is that of the sample before"));

  log = Example();
  log.velocity[1] = 1e40;
  WriteRecording(log, file.path());
  EXPECT_THAT(Refusal(file.path()), HasSubstr("velocity of sample 2 is 1e+40"));

  // as a row of a table without a number
  log.velocity[1] = std::nan("");
  WriteRecording(log, file.path());
  EXPECT_EQ(ReadRecordingFile(file.path(), {}).size(), Example().size() - 1);

  log = Example();
  log.load->conservativeResize(3);
  WriteRecording(log, file.path());
  EXPECT_THAT(Refusal(file.path()), HasSubstr("load has 3 samples where time has 4"));
}

TEST(Hdf5, EqualRecordingsAreEqualBytesAtAnyTime) {
  const TemporaryFile one("one.h5"), two("two.h5");
  WriteRecording(Example(), one.path());
  // the format's times count in seconds
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  WriteRecording(Example(), two.path());
  EXPECT_EQ(ReadWholeFile(one.path()), ReadWholeFile(two.path()));
}

TEST(Hdf5, FilesThatCrashTheLibraryAreRefused) {
  const auto folder = test::SharedFolder() / "data/hostile_hdf5";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  int refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with("crash")) continue;
    try {
      ReadRecordingFile(entry.path(), {}, 1);
    } catch (const BadInput& refusal) {
      EXPECT_THAT(refusal.what(), HasSubstr(name));
      ++refused;
    }
  }
  // one of the five crashes under sanitizers alone
  EXPECT_GE(refused, 4);
}

TEST(Hdf5, RefusesOtherFiles) {
  const TemporaryFile file("log.h5", "time,position\n");
  EXPECT_THAT(Refusal(file.path()),
              AllOf(HasSubstr("log.h5"), HasSubstr("cannot be read as HDF5")));
  EXPECT_THROW(ReadRecordingFile("there/is/none.h5"), BadInput);
}

TEST(Hdf5, LeavesNothingBehindWhereItCannotWrite) {
  EXPECT_THROW(WriteRecording(Example(), "there/is/no/folder.h5"), BadInput);
  EXPECT_FALSE(std::filesystem::exists("there"));
  EXPECT_THROW(WriteRecording(Example(), "log.xlsx"), BadInput);
}

/// A reader that a file took over: it sends its parent a byte now and then, for 5 s.
FileContent Trickle(const std::string&, const WantedColumns&) {
  for (int i = 0; i < 50; ++i) {
    for (int file = 3; file < 64; ++file) {
      struct stat status {};
      const bool is_pipe = fstat(file, &status) == 0 && S_ISFIFO(status.st_mode) &&
                           (fcntl(file, F_GETFL) & O_ACCMODE) == O_WRONLY;
      if (is_pipe && write(file, "c", 1) < 0) _exit(1);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  _exit(0);
}

TEST(ReadApart, EndsInTimeWhateverTheReaderSends) {
  EXPECT_THAT(
      [] {
        ReadApart({"trickle", &Trickle}, "absent", {}, 0.3);
      },
      testing::ThrowsMessage<BadInput>(testing::HasSubstr("within 0.3 s")));
}

/// A file with a dataset whose numbers lie elsewhere. make: fills it
std::string RefusalOfOther(const std::function<void(hid_t file)>& make) {
  const TemporaryFile path("log.h5");
  const hid_t file = H5Fcreate(path.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  make(file);
  H5Fclose(file);
  return Refusal(path.path());
}

TEST(Hdf5, ReadsNoOtherFile) {
  EXPECT_THAT(RefusalOfOther([](hid_t file) {
                const hsize_t size = 8;
                const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
                H5Pset_external(made, "/etc/passwd", 0, 64);
                const hid_t space = H5Screate_simple(1, &size, nullptr);
                H5Dclose(H5Dcreate2(file, "position", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, made,
                                    H5P_DEFAULT));
                H5Sclose(space);
                H5Pclose(made);
              }),
              HasSubstr("position has its numbers in another file"));
  EXPECT_THAT(RefusalOfOther([](hid_t file) {
                H5Lcreate_external("other.h5", "/time", file, "time", H5P_DEFAULT, H5P_DEFAULT);
              }),
              HasSubstr("time is a link to another file"));
}

TEST(Hdf5, SaysWhatWasMadeOfALog) {
  Measurements log = Example();
  log.notes = {"one", "two"};
  log.doubts = {"two"};
  const TemporaryFile file("log.h5");
  WriteRecording(log, file.path());
  const Measurements copy = ReadRecordingFile(file.path());
  // and once: reading adds that the torque is in A
  EXPECT_THAT(copy.notes, ElementsAre("one", "two", HasSubstr("torque A")));
  EXPECT_EQ(copy.doubts, log.doubts);
}

}  // namespace
}  // namespace warmjoint
