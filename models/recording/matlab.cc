#include "models/recording/matlab.h"

#include <matio.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/recording/assemble.h"
#include "models/recording/recording_columns.h"

namespace warmjoint {
namespace {

constexpr const char* kUnits = "unit";  // struct of texts

struct CloseMatlab {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatlabFile = std::unique_ptr<mat_t, CloseMatlab>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

/// Number of elements; 0 where the library states dimensions that no memory holds.
std::size_t CountOf(const matvar_t& variable) {
  std::size_t count = variable.rank > 0 ? 1 : 0;
  for (int i = 0; i < variable.rank; ++i) {
    if (__builtin_mul_overflow(count, variable.dims[i], &count)) return 0;
  }
  return count;
}

bool IsNumber(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64 &&
         !variable.isComplex;
}

bool IsVector(const matvar_t& variable) {
  return IsNumber(variable) && variable.rank == 2 && CountOf(variable) > 1 &&
         std::min(variable.dims[0], variable.dims[1]) == 1;
}

bool IsStruct(const matvar_t& variable) {
  return variable.class_type == MAT_C_STRUCT && CountOf(variable) == 1;
}

/// Calls `use` with the name and the value of each field of a struct of one element.
// none where the library cannot tell the names
void ForEachField(matvar_t& variable,
                  const std::function<void(const std::string&, matvar_t&)>& use) {
  char* const* names = Mat_VarGetStructFieldnames(&variable);
  const unsigned count = names ? Mat_VarGetNumberOfFields(&variable) : 0;
  for (unsigned i = 0; i < count; ++i) {
    matvar_t* const field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
    if (names[i] && field) use(names[i], *field);
  }
}

template <typename Number>
Eigen::VectorXd Numbers(const matvar_t& variable, std::size_t count) {
  const auto* numbers = static_cast<const Number*>(variable.data);
  return Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, 1>>(
             numbers, static_cast<Eigen::Index>(count))
      .template cast<double>();
}

/// The elements of a variable that was read; empty where the library read less than it states.
Eigen::VectorXd ValuesOf(const matvar_t& variable) {
  const std::size_t count = CountOf(variable);
  const auto size = static_cast<std::size_t>(std::max(variable.data_size, 0));
  if (!variable.data || size == 0 || variable.nbytes / size < count) return {};
  // by the type that the file has
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return Numbers<double>(variable, count);
    case MAT_C_SINGLE:
      return Numbers<float>(variable, count);
    case MAT_C_INT8:
      return Numbers<std::int8_t>(variable, count);
    case MAT_C_UINT8:
      return Numbers<std::uint8_t>(variable, count);
    case MAT_C_INT16:
      return Numbers<std::int16_t>(variable, count);
    case MAT_C_UINT16:
      return Numbers<std::uint16_t>(variable, count);
    case MAT_C_INT32:
      return Numbers<std::int32_t>(variable, count);
    case MAT_C_UINT32:
      return Numbers<std::uint32_t>(variable, count);
    case MAT_C_INT64:
      return Numbers<std::int64_t>(variable, count);
    case MAT_C_UINT64:
      return Numbers<std::uint64_t>(variable, count);
    default:
      return {};
  }
}

/// A text of plain characters; empty where it is none.
std::string TextOf(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || !variable.data) return "";
  // a unit or a kind of joint is short
  const std::size_t count = std::min<std::size_t>(CountOf(variable), 100);
  std::string text;
  // one or two bytes a character
  for (std::size_t i = 0; i < count; ++i) {
    const bool wide = variable.data_size == 2;
    const unsigned c = wide ? static_cast<const std::uint16_t*>(variable.data)[i]
                            : static_cast<const std::uint8_t*>(variable.data)[i];
    text += c < 128 ? static_cast<char>(c) : '?';
  }
  return text;
}

/// One vector of the file: where it lies, and under which name it counts.
struct Found {
  std::string variable, field;  // field: empty for a variable at the top
};

/// All vectors of the file, and the names of the structs that hold some.
struct Contents {
  std::vector<Found> found;
  std::vector<std::string> structs;
};

Contents FindVectors(mat_t* file) {
  Contents contents;
  while (const Variable variable{Mat_VarReadNextInfo(file)}) {
    if (!variable->name) continue;
    const std::string name = variable->name;
    if (IsVector(*variable)) contents.found.push_back({name, ""});
    // one level down, in structs other than that of the units
    if (!IsStruct(*variable) || name == kUnits) continue;
    const std::size_t before = contents.found.size();
    ForEachField(*variable, [&](const std::string& field, const matvar_t& value) {
      if (IsVector(value)) contents.found.push_back({name, field});
    });
    if (contents.found.size() > before) contents.structs.push_back(name);
  }
  return contents;
}

/// Whether all vectors lie in one struct, whose name may be left out.
bool IsOneStruct(const Contents& contents) {
  const auto at_top = [](const Found& one) { return one.field.empty(); };
  return contents.structs.size() == 1 && std::ranges::none_of(contents.found, at_top);
}

/// joint, gear and units, as far as the file holds them.
void ReadAttributes(mat_t* file, FileContent& content) {
  if (const Variable joint{Mat_VarRead(file, "joint")}) content.joint = TextOf(*joint);
  const Variable gear{Mat_VarRead(file, "gear")};
  if (gear && IsNumber(*gear)) {
    const Eigen::VectorXd values = ValuesOf(*gear);
    if (values.size() == 1) content.gear = values[0];
  }
  // units by the names of their columns
  const Variable units{Mat_VarRead(file, kUnits)};
  if (!units || !IsStruct(*units)) return;
  ForEachField(*units, [&](const std::string& name, const matvar_t& value) {
    for (FileColumn& column : content.columns) {
      if (column.name == name) column.unit = TextOf(value);
    }
  });
}

/// The vector, from the variable or from its field.
Eigen::VectorXd ReadVector(mat_t* file, const Found& found) {
  const Variable variable{Mat_VarRead(file, found.variable.c_str())};
  Eigen::VectorXd values;
  // a vector at the top, or a field of a struct
  if (variable && found.field.empty()) return ValuesOf(*variable);
  if (!variable) return values;
  ForEachField(*variable, [&](const std::string& name, const matvar_t& value) {
    if (name == found.field && IsVector(value)) values = ValuesOf(value);
  });
  return values;
}

}  // namespace

FileContent ReadMatlabContent(const std::string& path, const ReadSettings& layout) {
  const MatlabFile file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) {
    Refuse({path}, "cannot be read as a MATLAB file: it is damaged, or of another format");
  }
  // the names that vectors are known by
  const Contents contents = FindVectors(file.get());
  FileContent content;
  const bool one_struct = IsOneStruct(contents);
  for (const auto& [variable, field] : contents.found) {
    const std::string inside = one_struct ? field : variable + "." + field;
    content.columns.push_back({field.empty() ? variable : inside, "", {}});
  }
  ReadAttributes(file.get(), content);

  // the columns that are asked for
  const ReadSettings completed = WithAttributes(layout, content);
  for (const ColumnSource& source : FindColumns(NamesOf(content), completed, {path})) {
    FileColumn& column = content.columns[source.index];
    column.values = ReadVector(file.get(), contents.found[source.index]);
    if (column.values.size() == 0) {
      Refuse({path}, "{} cannot be read; the file is damaged", Excerpt(column.name));
    }
  }
  return content;
}

}  // namespace warmjoint
