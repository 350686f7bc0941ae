#include "models/recording/matlab.h"

#include "models/recording/matlab_content.h"
#include "models/recording/read_apart.h"

namespace warmjoint::inline models {

Measurements ReadMatlabApart(const std::string& path, const CsvLayout& layout, double patience) {
  return AssembleContent(ReadApart({"a MATLAB file", &ReadMatlabContent}, path, layout, patience),
                         path, layout);
}

}  // namespace warmjoint::inline models
