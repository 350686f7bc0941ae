// All joints of a tree slide to their sides, but for a few.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <span>
#include <vector>

#include "sim/plugin/inertia_block.h"
#include "sim/plugin/row_pairs.h"

namespace warmjoint {

/// What M^-1 makes of one vector of forces, and of forces of 1 at single joints, by the engine's own
/// factors of M, which take two vectors at once.
class InverseColumns {
 public:
  /// So many columns are kept.
  static constexpr int kMost = 6;

  InverseColumns() = default;
  /// size: of the tree.
  explicit InverseColumns(size_t size);

  /// Begins a step: solves for the forces kFriction of all rows, N.m or N, and for the column of the
  /// joint that needs one soonest.
  void Start(const InertiaBlock& inertia, const mjData* d, Rows rows, int likely);

  /// M^-1 of those forces until Add, two rows at once.
  Two bearing(size_t k) const { return {solved_[2 * k][0], solved_[2 * k + 1][0]}; }

  /// The place of a joint's column; -1 where it is not there.
  int Find(int joint) {
    // the first question is when a column is needed at all
    if (count_ == 0) Keep(likely_, 1);
    int place = count_ - 1;
    while (place >= 0 && joints_[place] != joint) --place;
    return place;
  }

  /// Adds the columns of joints that have none, in their order; false, and nothing done, where they do
  /// not fit in.
  bool Add(const InertiaBlock& inertia, const mjData* d, std::span<const int> joints);

  int count() const { return count_; }

  /// Two rows at once.
  const Two* operator[](int place) const { return columns_.data() + place * pairs_; }

 private:
  void Keep(int joint, int lane);

  size_t pairs_ = 0;
  std::vector<Two> solved_;   // of each row: two vectors
  std::vector<Two> columns_;  // [kMost][pairs]
  std::array<int, kMost> joints_{};
  int count_ = 0;
  int likely_ = 0;  // the joint whose column Start has solved for
};

/// The projection onto the levels (BoxProjection) where most joints slide to a side that is known, by
/// the engine's factors of the whole inertia matrix M. With all of them at their levels each would
/// slip by `start`; what slips away from its side is held, or slides to the other side. With e_k for
/// what the force of such a joint lacks to its level, and c_k for M^-1's column,
///   slip = start + sum_k c_k e_k
/// which is 0 at each one that is held: as many equations as there are such joints.
class FewHeld {
 public:
  /// So many may not slide to their side before a block of M is factorised instead.
  static constexpr int kMost = 4;

  FewHeld() = default;
  /// size: of the tree.
  explicit FewHeld(size_t size) : pairs_((size + 1) / 2), columns_(size) {}

  /// Begins a step: finds what all would bear, and a column beforehand. rows: kFriction holds the
  /// level on each one's side, N.m or N; likely: the joint that needs a column soonest.
  void Start(const InertiaBlock& inertia, const mjData* d, Rows rows, int likely) {
    columns_.Start(inertia, d, rows, likely);
    apart_count_ = 0;
    missing_ = false;
  }

  /// M^-1 of those levels until Find, two rows at once.
  Two bearing(size_t k) const { return columns_.bearing(k); }

  /// Finds what slips away from its side, beginning with what the last call has found. side: 1, -1, or
  /// 0 without friction; start, slip: two rows at once. False where those are too many.
  bool Find(const InertiaBlock& inertia, const mjData* d, AskedLevels& levels, const Two* side,
            const Two* start, Two* slip);

  /// Makes the levels of those that are held now so many times as high from here on.
  void Widen(double times);

  /// Writes kSliding of the joints that do not slide to their side.
  void SetSliding(Rows rows) const;

  /// Writes kFriction of the joints that do not slide to their side.
  void SetFriction(Rows rows) const;

 private:
  enum class Does { hold, slide_to_side, slide_to_other };

  /// A joint that does not slide to its side at the level that it has there.
  struct Apart {
    int joint = 0;
    int column = -1;  // its place in columns_
    Does does = Does::hold;
    double side = 0;   // that it would have
    double level = 0;  // there, with the force's sign, N.m or N
    double most = 0;   // bounds of its force, there and on the other side
    double other = 0;
    double lack = 0;  // of its force to the level, N.m or N

    bool held() const { return does == Does::hold; }
    double force() const { return level - lack; }
    /// Of one that slides.
    double bound() const { return does == Does::slide_to_side ? most : other; }
    Does better() const {
      if (side * force() > side * most) return Does::slide_to_side;
      return side * force() < side * other ? Does::slide_to_other : Does::hold;
    }
  };

  bool IsApart(int joint) const;
  bool AddWrong(AskedLevels& levels, const Two* side, const Two* slip);
  void Add(int joint, double side, AskedLevels& levels);
  bool FindColumns(const InertiaBlock& inertia, const mjData* d);
  const Two* ColumnOf(const Apart& apart) const { return columns_[apart.column]; }
  void FindLack(const Two* start);
  bool Slip(const Two* side, const Two* start, Two* slip) const;
  bool Change(const Two* slip);

  size_t pairs_ = 0;
  InverseColumns columns_;
  std::array<Apart, kMost> apart_{};
  int apart_count_ = 0;
  bool missing_ = false;  // a column of one that is apart
};

}  // namespace warmjoint
