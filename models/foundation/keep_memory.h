// Memory that is freed stays with the program.
#pragma once

#include <cstdlib>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace warmjoint {

/// For main functions: arrays of samples (some 100 kB each) come and go by the thousand. By default
/// glibc asks the kernel for each and gives it back, which costs a quarter of a fit in page faults;
/// from here on blocks below 64 MiB are kept and used again. Nothing elsewhere.
inline void KeepFreedMemory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_TOP_PAD, 16 << 20);
#endif
}

}  // namespace warmjoint
