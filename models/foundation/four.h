// Four numbers side by side, and functions made for processors that take them at once.
#pragma once

#include <array>
#include <cstdlib>  // tells whether the C library is glibc
#include <cstring>

namespace warmjoint {

/// One register of AVX, two of SSE2. Handed by reference: by value each processor would have a calling convention of its own.
using Four = double __attribute__((vector_size(32)));

/// Several of them: 4 F numbers side by side.
template <std::size_t F>
using Fours = std::array<Four, F>;

/// Reads four numbers from anywhere.
inline void Load(const double* from, Four& four) { std::memcpy(&four, from, sizeof(Four)); }

/// Writes four numbers to anywhere.
inline void Store(const Four& four, double* to) { std::memcpy(to, &four, sizeof(Four)); }

/// The sum of four numbers, always in the same order.
inline double SumOf(const Four& four) { return (four[0] + four[1]) + (four[2] + four[3]); }

}  // namespace warmjoint

// A function that is compiled twice, with all that it calls: for any x86-64 processor, and for those with AVX (since
// 2011; asked for by FMA, since 2013), which take four numbers at once. The loader picks. Products are not joined with
// sums (-ffp-contract=off), so that both give the same bits. Sanitizers start only after the loader has picked.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define WARMJOINT_FOR_EACH_PROCESSOR __attribute__((target_clones("fma", "default"), flatten))
#else
#define WARMJOINT_FOR_EACH_PROCESSOR
#endif
