// Recordings as MATLAB files.
#include "tests/fuzz/logs.h"

void warmjoint::fuzz::Read(std::string_view bytes) { ReadBinaryLog(bytes, ".mat", 0.25); }
