// Columns of numbers that need little memory however long they grow.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <vector>

namespace warmjoint::inline tools {

/// Numbers that enter and leave a file together.
using NumberBlock = std::array<double, 1024>;

/// A file without a name in the folder of temporary files (TMPDIR), which many columns share. It is made
/// when the first block is written, and is gone when the last column is, however the process ends.
class NumberFile {
 public:
  /// Appends one block and returns its position. Throws OutputFailed where there is no room.
  std::uint32_t Write(const NumberBlock& block);

  void Read(std::uint32_t position, NumberBlock& block) const;

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
  std::uint32_t blocks_ = 0;
};

/// A column that grows at its end and is read from its beginning. Of a long one, at most one block is in
/// memory, and four bytes for each of the others.
class NumberColumn {
 public:
  explicit NumberColumn(std::shared_ptr<NumberFile> file = std::make_shared<NumberFile>());

  void Add(double value);
  /// Adds all numbers of another one.
  void Add(const NumberColumn& other);

  std::size_t size() const {
    return blocks_.size() * std::tuple_size_v<NumberBlock> + tail_.size();
  }

  /// The column is read by blocks; the last one holds the rest.
  std::size_t parts() const { return blocks_.size() + 1; }
  /// Part i, which lies in `buffer` where it comes from the file.
  std::span<const double> Part(std::size_t i, NumberBlock& buffer) const;

  /// Calls work(value) for each number in the order of the column.
  template <typename Work>
  void ForEach(const Work& work) const {
    NumberBlock buffer;
    for (std::size_t i = 0; i < parts(); ++i) {
      for (const double value : Part(i, buffer)) work(value);
    }
  }

 private:
  std::shared_ptr<NumberFile> file_;
  std::vector<std::uint32_t> blocks_;  // positions in the file
  std::vector<double> tail_;           // what is no whole block yet
};

/// Calls work(a[i], b[i]) for all i below the size of the shorter one.
template <typename Work>
void ForEachPair(const NumberColumn& a, const NumberColumn& b, const Work& work) {
  NumberBlock of_a, of_b;
  for (std::size_t i = 0; i < std::min(a.parts(), b.parts()); ++i) {
    const std::span<const double> left = a.Part(i, of_a), right = b.Part(i, of_b);
    for (std::size_t j = 0; j < std::min(left.size(), right.size()); ++j) work(left[j], right[j]);
  }
}

}  // namespace warmjoint::inline tools
