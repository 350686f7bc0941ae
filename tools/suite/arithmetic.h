// What a machine's arithmetic is, down to the last bit.
#pragma once

#include <string>

namespace warmjoint::inline tools {

/// glibc takes exp, log, pow, sin and others in a form with fused multiply-adds where the CPU has them,
/// and that form gives other last bits. This starts the running program anew with those forms masked by
/// GLIBC_TUNABLES, so that every x86-64 CPU calculates the same; it returns where that is done already,
/// or cannot be done. For the beginning of a command, before anything is read or written.
void SettleArithmetic();

/// Value of GLIBC_TUNABLES that masks those forms besides what `tunables` says.
std::string SettledTunables(const std::string& tunables);

/// Digest of a fixed calculation: the mathematical functions at some thousand arguments, and a short
/// realization of the ideal plant and of MuJoCo with fits of both, 16 hexadecimal digits. Machines with
/// the same digest give a suite the same bytes; takes some hundredths of a second, once.
const std::string& ArithmeticDigest();

/// The part of it that is the mathematical functions alone.
std::string DigestOfFunctions();

}  // namespace warmjoint::inline tools
