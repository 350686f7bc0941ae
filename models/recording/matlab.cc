#include <hdf5.h>
#include <matio.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/recording/arrays.h"
#include "models/recording/read_recording.h"

namespace warmjoint {
namespace {

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

/// Every step-th number from `first` on.
template <typename Number>
Eigen::VectorXd Numbers(const matvar_t& variable, Eigen::Index first, Eigen::Index step,
                        Eigen::Index count) {
  const auto* numbers = static_cast<const Number*>(variable.data) + first;
  return Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, 1>, 0, Eigen::InnerStride<>>(
             numbers, count, Eigen::InnerStride<>(step))
      .template cast<double>();
}

/// By the type that the file has, in the order of the library's classes from MAT_C_DOUBLE on.
constexpr decltype(&Numbers<double>) kNumbers[]{
    Numbers<double>,       Numbers<float>,         Numbers<std::int8_t>,  Numbers<std::uint8_t>,
    Numbers<std::int16_t>, Numbers<std::uint16_t>, Numbers<std::int32_t>, Numbers<std::uint32_t>,
    Numbers<std::int64_t>, Numbers<std::uint64_t>};

/// One column of a variable of numbers, whose first dimension runs fastest; empty where the file holds less than it states.
Eigen::VectorXd ValuesOf(const matvar_t& variable, const ArrayColumn& column) {
  const std::size_t all = CountOf(variable);
  const auto size = static_cast<std::size_t>(std::max(variable.data_size, 0));
  if (!variable.data || size == 0 || variable.nbytes / size < all) return {};
  // how far apart the samples are, and the columns
  const auto distance = [&](std::size_t dimension) {
    return static_cast<Eigen::Index>(std::accumulate(variable.dims, variable.dims + dimension,
                                                     std::size_t{1}, std::multiplies<>()));
  };
  const auto rank = static_cast<std::size_t>(variable.rank);
  if (column.along >= rank || column.across >= rank || !IsNumber(variable)) return {};
  const Eigen::Index step = distance(column.along), first = column.index * distance(column.across);
  const Eigen::Index count = column.count;
  if (count < 1 || first + (count - 1) * step >= static_cast<Eigen::Index>(all)) return {};
  return kNumbers[variable.class_type - MAT_C_DOUBLE](variable, first, step, count);
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

/// Adds a variable, and the fields of structs in it, but no texts and scalars. read: reads all of it.
void AddVariable(matvar_t& variable, const std::string& path, int depth,
                 const std::function<void()>& read, std::vector<FileObject>& objects) {
  if (objects.size() >= kMostObjects || depth > kDeepestGroup) return;
  if (IsStruct(variable)) {
    ForEachField(variable, [&](const std::string& field, matvar_t& value) {
      AddVariable(value, path + "." + field, depth + 1, read, objects);
    });
    return;
  }
  const bool numbers = IsNumber(variable);
  if (variable.class_type == MAT_C_CHAR || (numbers && CountOf(variable) < 2)) return;
  const auto* dims = variable.dims;
  objects.push_back({path, {dims, dims + (dims ? variable.rank : 0)}});
  if (!numbers) return;
  objects.back().read = [&variable, read](const ArrayColumn& column) {
    if (!variable.data) read();
    return ValuesOf(variable, column);
  };
}

/// Takes units by the last names of paths.
void TakeUnits(mat_t* file, std::vector<FileObject>& objects) {
  const Variable units{Mat_VarRead(file, "unit")};
  if (!units || !IsStruct(*units)) return;
  ForEachField(*units, [&](const std::string& name, const matvar_t& value) {
    for (FileObject& object : objects) {
      if (object.path.substr(object.path.rfind('.') + 1) == name) object.unit = TextOf(value);
    }
  });
}

}  // namespace

FileContent ReadMatlabContent(const std::string& path, const WantedColumns& wanted) {
  // those of version 7.3 are HDF5
  if (H5Fis_hdf5(path.c_str()) > 0) RefuseOtherFiles(path);
  const MatlabFile file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) {
    Refuse({path}, "cannot be read as a MATLAB file: it is damaged, or of another format");
  }
  // what the file holds, without any values yet
  std::vector<Variable> variables;
  std::vector<FileObject> objects;
  while (Variable variable{Mat_VarReadNextInfo(file.get())}) {
    variables.push_back(std::move(variable));
    matvar_t& kept = *variables.back();
    const auto read = [&file, &kept] { Mat_VarReadDataAll(file.get(), &kept); };
    if (kept.name) AddVariable(kept, kept.name, 0, read, objects);
  }
  TakeUnits(file.get(), objects);
  // what it says of itself
  FileContent content;
  if (const Variable joint{Mat_VarRead(file.get(), "joint")}) content.joint = TextOf(*joint);
  const Variable gear{Mat_VarRead(file.get(), "gear")};
  if (gear && CountOf(*gear) == 1) {
    const Eigen::VectorXd values = ValuesOf(*gear, {.count = 1});
    if (values.size() == 1) content.gear = values[0];
  }
  return TakeColumns(std::move(content), objects, wanted, {path});
}

}  // namespace warmjoint
