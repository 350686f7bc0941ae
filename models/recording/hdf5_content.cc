#include "models/recording/hdf5_content.h"

#include <H5Cpp.h>

#include "models/foundation/excerpt.h"
#include "models/recording/recording_columns.h"

namespace warmjoint::inline models {
namespace {

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
  // one dimension of numbers
  if (root.childObjType(name) != H5O_TYPE_DATASET) return false;
  const H5::DataSet data = root.openDataSet(name);
  const H5T_class_t type = data.getTypeClass();
  return data.getSpace().getSimpleExtentNdims() == 1 && (type == H5T_FLOAT || type == H5T_INTEGER);
}

Eigen::VectorXd ReadValues(const H5::DataSet& data, const std::string& name, const Place& place) {
  // what a damaged file states is not believed
  const hssize_t count = data.getSpace().getSimpleExtentNpoints();
  if (count < 0 || static_cast<unsigned long long>(count) > kMostSamples) {
    Refuse(place, "{} states {} samples; {} at most are read", Excerpt(name), count, kMostSamples);
  }
  Eigen::VectorXd values(static_cast<Eigen::Index>(count));
  data.read(values.data(), H5::PredType::NATIVE_DOUBLE);
  return values;
}

FileContent Read(const std::string& path, const CsvLayout& layout) {
  const H5::H5File file(path, H5F_ACC_RDONLY);
  const H5::Group root = file.openGroup("/");
  // what the file says of itself, without any values yet
  FileContent content;
  content.joint = ReadTextAttribute(root, "joint");
  if (root.attrExists("gear")) {
    content.gear.emplace();
    root.openAttribute("gear").read(H5::PredType::NATIVE_DOUBLE, &*content.gear);
  }
  for (hsize_t i = 0; i < root.getNumObjs(); ++i) {
    const std::string name = root.getObjnameByIdx(i);
    if (!IsColumn(root, name)) continue;
    content.columns.push_back({name, ReadTextAttribute(root.openDataSet(name), "unit"), {}});
  }

  // values of the columns that are asked for alone
  const CsvLayout completed = WithAttributes(layout, content);
  for (const ColumnSource& source : FindColumns(NamesOf(content), completed, {path})) {
    FileColumn& column = content.columns[source.index];
    column.values = ReadValues(root.openDataSet(column.name), column.name, {path});
  }
  return content;
}

}  // namespace

FileContent ReadHdf5Content(const std::string& path, const CsvLayout& layout) {
  H5::Exception::dontPrint();
  try {
    return Read(path, layout);
  } catch (const H5::Exception& error) {
    Refuse({path}, "cannot be read as HDF5: {}", Excerpt(error.getDetailMsg(), kLongestComplaint));
  }
}

}  // namespace warmjoint::inline models
