// The sources that each FMU holds, as they were when this was compiled.
#pragma once

namespace warmjoint {

extern const char* const kFmuSource;         // fmu/warmjoint_fmu.c
extern const char* const kCompensateHeader;  // <warmjoint/compensate.h>

}  // namespace warmjoint
