#include "models/recording/hdf5.h"

#include <H5Cpp.h>

#include <algorithm>

#include "models/foundation/atomic_file.h"
#include "models/recording/assemble.h"

namespace warmjoint::inline models {
namespace {

const H5::StrType& Text() {
  static const H5::StrType text(H5::PredType::C_S1, H5T_VARIABLE);
  return text;
}

void WriteAttribute(H5::H5Object& object, const std::string& name, const std::string& value) {
  object.createAttribute(name, Text(), H5::DataSpace()).write(Text(), value);
}

/// The text of an attribute; empty where there is none.
std::string ReadTextAttribute(const H5::H5Object& object, const std::string& name) {
  if (!object.attrExists(name)) return "";
  const H5::Attribute attribute = object.openAttribute(name);
  if (attribute.getTypeClass() != H5T_STRING) return "";
  std::string value;
  attribute.read(attribute.getDataType(), value);
  return value.substr(0, value.find('\0'));
}

bool IsColumn(const H5::Group& root, const std::string& name) {
  if (root.childObjType(name) != H5O_TYPE_DATASET) return false;
  const H5::DataSet data = root.openDataSet(name);
  const H5T_class_t type = data.getTypeClass();
  return data.getSpace().getSimpleExtentNdims() == 1 && (type == H5T_FLOAT || type == H5T_INTEGER);
}

std::vector<std::string> ColumnNames(const H5::Group& root) {
  std::vector<std::string> names;
  for (hsize_t i = 0; i < root.getNumObjs(); ++i) {
    const std::string name = root.getObjnameByIdx(i);
    if (IsColumn(root, name)) names.push_back(name);
  }
  return names;
}

/// The layout, completed by what the file says of itself.
CsvLayout WithAttributes(CsvLayout layout, const H5::Group& root,
                         const std::vector<std::string>& names) {
  if (ReadTextAttribute(root, "joint") == "linear") layout.joint = JointKind::linear;
  if (layout.gear == 1 && root.attrExists("gear")) {
    root.openAttribute("gear").read(H5::PredType::NATIVE_DOUBLE, &layout.gear);
  }
  for (const RecordingColumn& column : RecordingColumns()) {
    const auto mapped = layout.column.find(column.name);
    const std::string theirs = mapped == layout.column.end() ? column.name : mapped->second;
    if (std::find(names.begin(), names.end(), theirs) == names.end()) continue;
    const std::string unit = ReadTextAttribute(root.openDataSet(theirs), "unit");
    if (!unit.empty()) layout.unit.emplace(column.name, unit);
  }
  return layout;
}

Eigen::VectorXd ReadColumn(const H5::Group& root, const std::string& name) {
  const H5::DataSet data = root.openDataSet(name);
  Eigen::VectorXd values(static_cast<Eigen::Index>(data.getSpace().getSimpleExtentNpoints()));
  data.read(values.data(), H5::PredType::NATIVE_DOUBLE);
  return values;
}

Measurements Read(const std::string& path, const CsvLayout& given) {
  const H5::H5File file(path, H5F_ACC_RDONLY);
  const H5::Group root = file.openGroup("/");
  const std::vector<std::string> names = ColumnNames(root);
  const CsvLayout layout = WithAttributes(given, root, names);
  const std::vector<ColumnSource> sources = FindColumns(names, layout, {path});

  RawColumns raw{path, {}, {}};
  for (const ColumnSource& source : sources) {
    raw.values.push_back(ReadColumn(root, names[source.index]));
    if (raw.values.back().size() == raw.values.front().size()) continue;
    Refuse({path}, "{} has {} samples where {} has {}; all columns must be of one length",
           names[source.index], raw.values.back().size(), names[sources.front().index],
           raw.values.front().size());
  }
  return AssembleMeasurements(std::move(raw), sources, layout);
}

void Write(const Measurements& measurements, const std::string& path) {
  H5::H5File file(path, H5F_ACC_TRUNC);
  H5::Group root = file.openGroup("/");
  WriteAttribute(root, "joint", measurements.joint == JointKind::linear ? "linear" : "rotary");
  root.createAttribute("gear", H5::PredType::NATIVE_DOUBLE, H5::DataSpace())
      .write(H5::PredType::NATIVE_DOUBLE, &measurements.gear);

  for (const RecordingColumn& column : RecordingColumns()) {
    const Eigen::VectorXd* values = column.get(measurements);
    if (!values) continue;
    const hsize_t size = static_cast<hsize_t>(values->size());
    H5::DataSet data =
        root.createDataSet(column.name, H5::PredType::NATIVE_DOUBLE, H5::DataSpace(1, &size));
    data.write(values->data(), H5::PredType::NATIVE_DOUBLE);
    WriteAttribute(data, "unit", UnitOf(column, measurements));
  }
}

}  // namespace

Measurements ReadHdf5(const std::string& path, const CsvLayout& layout) {
  H5::Exception::dontPrint();
  try {
    return Read(path, layout);
  } catch (const H5::Exception& error) {
    Refuse({path}, "cannot be read as HDF5: {}", error.getDetailMsg());
  }
}

void WriteHdf5(const Measurements& measurements, const std::string& path) {
  H5::Exception::dontPrint();
  AtomicFile file(path);
  try {
    Write(measurements, file.temporary());
  } catch (const H5::Exception& error) {
    Refuse({path}, "cannot be written as HDF5: {}", error.getDetailMsg());
  }
  file.Commit();
}

}  // namespace warmjoint::inline models
