// Entry point of the CSV fuzzer.
#pragma once

#include <cstddef>
#include <cstdint>

/// Reads the bytes as a recording: they are refused with BadInput, or give measurements that keep
/// their promises and can be checked. Anything else ends the process.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
