// Recordings as HDF5.
#include "tests/fuzz/logs.h"

// good ones take 5 ms
void warmjoint::fuzz::Read(std::string_view bytes) { ReadBinaryLog(bytes, ".h5", 0.05); }
