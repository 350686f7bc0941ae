#include "models/recording/hdf5.h"

#include <H5Cpp.h>

#include <algorithm>
#include <mutex>

#include "models/foundation/atomic_file.h"
#include "models/recording/hdf5_content.h"
#include "models/recording/read_apart.h"
#include "models/recording/recording_columns.h"
#include "models/recording/units.h"

namespace warmjoint::inline models {
namespace {

const H5::StrType& Text() {
  static const H5::StrType text(H5::PredType::C_S1, H5T_VARIABLE);
  return text;
}

void WriteAttribute(H5::H5Object& object, const std::string& name, const std::string& value) {
  object.createAttribute(name, Text(), H5::DataSpace()).write(Text(), value);
}

/// Properties that leave the time of writing out, so that equal recordings are equal files.
template <typename PropList>
PropList WithoutTimes() {
  PropList properties;
  H5Pset_obj_track_times(properties.getId(), false);
  return properties;
}

void WriteObjects(const Measurements& measurements, H5::H5File& file) {
  // the joint, and each column with its unit
  H5::Group root = file.openGroup("/");
  WriteAttribute(root, "joint", measurements.joint == JointKind::linear ? "linear" : "rotary");
  root.createAttribute("gear", H5::PredType::NATIVE_DOUBLE, H5::DataSpace())
      .write(H5::PredType::NATIVE_DOUBLE, &measurements.gear);

  // a dataset for each column that is there, with its unit
  const auto timeless = WithoutTimes<H5::DSetCreatPropList>();
  for (const RecordingColumn& column : RecordingColumns()) {
    const Eigen::VectorXd* values = column.get(measurements);
    if (!values) continue;
    const hsize_t size = static_cast<hsize_t>(values->size());
    H5::DataSet data = root.createDataSet(column.name, H5::PredType::NATIVE_DOUBLE,
                                          H5::DataSpace(1, &size), timeless);
    data.write(values->data(), H5::PredType::NATIVE_DOUBLE);
    WriteAttribute(data, "unit", UnitOf(column, measurements));
  }
}

/// The bytes of the file, made in memory: the library never opens a name on disk.
std::string Image(const Measurements& measurements) {
  constexpr std::size_t kGrowth = 1 << 20;  // bytes
  H5::FileAccPropList in_memory;
  in_memory.setCore(kGrowth, false);
  H5::H5File file("recording.h5", H5F_ACC_TRUNC, WithoutTimes<H5::FileCreatPropList>(), in_memory);
  WriteObjects(measurements, file);
  file.flush(H5F_SCOPE_GLOBAL);

  // first how many bytes there are, then the bytes
  const ssize_t size = H5Fget_file_image(file.getId(), nullptr, 0);
  std::string image(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (size <= 0 || H5Fget_file_image(file.getId(), image.data(), image.size()) != size) {
    throw H5::FileIException("Image", "the library gives no image of the file");
  }
  return image;
}

}  // namespace

Measurements ReadHdf5(const std::string& path, const CsvLayout& layout) {
  return AssembleContent(ReadHdf5Content(path, layout), path, layout);
}

Measurements ReadHdf5Apart(const std::string& path, const CsvLayout& layout, double patience) {
  return AssembleContent(ReadApart({"HDF5", &ReadHdf5Content}, path, layout, patience), path,
                         layout);
}

std::string RecordingToHdf5(const Measurements& measurements) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  H5::Exception::dontPrint();
  try {
    return Image(measurements);
  } catch (const H5::Exception& error) {
    Refuse({"recording"}, "cannot be written as HDF5: {}", error.getDetailMsg());
  }
}

void WriteHdf5(const Measurements& measurements, const std::string& path) {
  WriteWholeFile(path, RecordingToHdf5(measurements));
}

}  // namespace warmjoint::inline models
