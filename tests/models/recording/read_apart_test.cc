#include "models/recording/read_apart.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {

/// A reader that a file took over: it sends its parent a byte now and then, for 5 s.
FileContent Trickle(const std::string&, const ReadSettings&) {
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

}  // namespace
}  // namespace warmjoint
