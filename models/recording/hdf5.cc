#include <H5Cpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <mutex>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/recording/arrays.h"
#include "models/recording/read_recording.h"
#include "models/recording/recording_columns.h"

namespace warmjoint {
namespace {

constexpr const char *kNotes = "notes", *kDoubts = "doubts";  // attributes of the root

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
  WriteAttribute(root, "joint", std::string(NameOf(measurements.joint)));
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

/// What was made of a log, one sentence a line.
void WriteSaid(const std::vector<std::string>& notes, const std::vector<std::string>& doubts,
               H5::H5File& file) {
  H5::Group root = file.openGroup("/");
  const auto join = [](const std::vector<std::string>& lines) {
    return fmt::format("{}", fmt::join(lines, "\n"));
  };
  if (!notes.empty()) WriteAttribute(root, kNotes, join(notes));
  if (!doubts.empty()) WriteAttribute(root, kDoubts, join(doubts));
}

/// Adds a dataset, and the groups that its name states.
void WriteColumn(const FileColumn& column, H5::H5File& file) {
  const auto timeless = WithoutTimes<H5::DSetCreatPropList>();
  const auto size = static_cast<hsize_t>(column.values.size());
  H5::LinkCreatPropList with_groups;
  with_groups.setCreateIntermediateGroup(true);
  H5::DataSet data(H5Dcreate2(file.getId(), column.name.c_str(),
                              H5::PredType::NATIVE_DOUBLE.getId(), H5::DataSpace(1, &size).getId(),
                              with_groups.getId(), timeless.getId(), H5P_DEFAULT));
  data.write(column.values.data(), H5::PredType::NATIVE_DOUBLE);
  if (!column.unit.empty()) WriteAttribute(data, "unit", column.unit);
}

/// The bytes of a file, made in memory: the library never opens a name on disk. write: fills it.
std::string Image(const std::function<void(H5::H5File&)>& write) {
  constexpr std::size_t kGrowth = 1 << 20;  // bytes
  H5::FileAccPropList in_memory;
  in_memory.setCore(kGrowth, false);
  H5::H5File file("recording.h5", H5F_ACC_TRUNC, WithoutTimes<H5::FileCreatPropList>(), in_memory);
  write(file);
  file.flush(H5F_SCOPE_GLOBAL);

  // first how many bytes there are, then the bytes
  const ssize_t size = H5Fget_file_image(file.getId(), nullptr, 0);
  std::string image(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (size <= 0 || H5Fget_file_image(file.getId(), image.data(), image.size()) != size) {
    throw H5::FileIException("Image", "the library gives no image of the file");
  }
  return image;
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

/// The lines of such an attribute.
std::vector<std::string> ReadLines(const H5::H5Object& object, const std::string& name) {
  std::vector<std::string> lines;
  std::string_view text;
  const std::string all = ReadTextAttribute(object, name);
  for (text = all; !text.empty();) {
    const std::size_t end = text.find('\n');
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

/// What leads out of a file.
struct OtherFile {
  std::string path;  // of the object; empty: none was found
  std::string what;
  std::size_t left = kMostObjects;
};

/// Looks at one link: a member of H5Lvisit. 0: goes on.
herr_t LookForOtherFile(hid_t group, const char* name, const H5L_info_t* link, void* found) {
  auto& other = *static_cast<OtherFile*>(found);
  const auto end = [&](const char* what) {
    other.path = name;
    other.what = what;
    return 1;
  };
  if (link->type == H5L_TYPE_EXTERNAL) return end("is a link to another file");
  if (other.left-- == 0) return end("is one object of too many");
  if (link->type != H5L_TYPE_HARD) return 0;
  const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
  if (object < 0) return 0;
  herr_t result = 0;
  if (H5Iget_type(object) == H5I_DATASET) {
    const hid_t made = H5Dget_create_plist(object);
    if (H5Pget_external_count(made) > 0) result = end("has its numbers in another file");
    if (H5Pget_layout(made) == H5D_VIRTUAL) result = end("is made of other datasets");
    H5Pclose(made);
  }
  H5Oclose(object);
  return result;
}

/// One column, without the rest of its array.
Eigen::VectorXd ReadValues(const H5::DataSet& data, const ArrayColumn& column) {
  H5::DataSpace space = data.getSpace();
  const auto rank = static_cast<std::size_t>(space.getSimpleExtentNdims());
  std::vector<hsize_t> start(rank, 0), count(rank, 1);
  start[column.across] = static_cast<hsize_t>(column.index);
  count[column.along] = static_cast<hsize_t>(column.count);
  space.selectHyperslab(H5S_SELECT_SET, count.data(), start.data());
  Eigen::VectorXd values(column.count);
  data.read(values.data(), H5::PredType::NATIVE_DOUBLE, H5::DataSpace(1, &count[column.along]),
            space);
  return values;
}

/// Adds a dataset of numbers, or one that tools/convert reads.
void AddDataSet(const H5::DataSet& data, const std::string& path,
                std::vector<FileObject>& objects) {
  const H5T_class_t type = data.getTypeClass();
  const bool numbers = type == H5T_FLOAT || type == H5T_INTEGER;
  if (!numbers && type != H5T_COMPOUND && type != H5T_REFERENCE) return;
  std::vector<hsize_t> shape(static_cast<std::size_t>(data.getSpace().getSimpleExtentNdims()));
  if (shape.empty()) return;
  data.getSpace().getSimpleExtentDims(shape.data());
  objects.push_back({path, {shape.begin(), shape.end()}});
  if (!numbers) return;
  objects.back().read = [data](const ArrayColumn& column) { return ReadValues(data, column); };
  objects.back().unit = ReadTextAttribute(data, "unit");
}

/// Where a group lies in its file: that of two names of one group.
haddr_t AddressOf(const H5::Group& group) {
  H5O_info_t info{};
  return H5Oget_info2(group.getId(), &info, H5O_INFO_BASIC) < 0 ? HADDR_UNDEF : info.addr;
}

/// Adds what a group holds, groups in it included. left: objects that may still be looked at. above: where the groups around it lie; a
/// group that holds one of them has nothing new.
void AddGroup(const H5::Group& group, const std::string& path, std::vector<haddr_t> above,
              std::size_t& left, std::vector<FileObject>& objects) {
  const haddr_t here = AddressOf(group);
  if (above.size() > kDeepestGroup || std::ranges::find(above, here) != above.end()) return;
  above.push_back(here);
  for (hsize_t i = 0; i < group.getNumObjs() && left > 0; ++i) {
    --left;
    const std::string name = group.getObjnameByIdx(i);
    // a link to what is not there is no reason to refuse the rest
    try {
      const H5O_type_t type = group.childObjType(name);
      if (type == H5O_TYPE_DATASET) AddDataSet(group.openDataSet(name), path + name, objects);
      if (type != H5O_TYPE_GROUP) continue;
      AddGroup(group.openGroup(name), path + name + "/", above, left, objects);
    } catch (const H5::Exception&) {
      continue;
    }
  }
}

/// The bytes of a file, one at a time: the library serves one thread.
std::string Written(const std::function<void(H5::H5File&)>& write) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  H5::Exception::dontPrint();
  try {
    return Image(write);
  } catch (const H5::Exception& error) {
    Refuse({"recording"}, "cannot be written as HDF5: {}", error.getDetailMsg());
  }
}

}  // namespace

void RefuseOtherFiles(const std::string& path) {
  H5::Exception::dontPrint();
  // filters of other programs are not loaded either
  H5PLset_loading_state(0);
  OtherFile other;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return;  // no HDF5: its reader says so
  H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, LookForOtherFile, &other);
  H5Fclose(file);
  if (other.path.empty()) return;
  Refuse({path}, "{} {}; a recording is one file: copy its datasets into it", Excerpt(other.path),
         other.what);
}

FileContent ReadHdf5Content(const std::string& path, const WantedColumns& wanted) {
  RefuseOtherFiles(path);
  H5::Exception::dontPrint();
  try {
    const H5::H5File file(path, H5F_ACC_RDONLY);
    const H5::Group root = file.openGroup("/");
    // what the file says of itself, without any values yet
    FileContent content{.joint = ReadTextAttribute(root, "joint"),
                        .notes = ReadLines(root, kNotes),
                        .doubts = ReadLines(root, kDoubts)};
    if (root.attrExists("gear")) {
      root.openAttribute("gear").read(H5::PredType::NATIVE_DOUBLE, &content.gear.emplace());
    }
    std::vector<FileObject> objects;
    std::size_t left = kMostObjects;
    AddGroup(root, "", {}, left, objects);
    return TakeColumns(std::move(content), objects, wanted, {path});
  } catch (const H5::Exception& error) {
    Refuse({path}, "cannot be read as HDF5: {}", Excerpt(error.getDetailMsg(), kLongestComplaint));
  }
}

std::string RecordingToHdf5(const Measurements& measurements) {
  return Written([&](H5::H5File& file) {
    WriteObjects(measurements, file);
    WriteSaid(measurements.notes, measurements.doubts, file);
  });
}

std::string ColumnsToHdf5(const FileContent& content) {
  return Written([&](H5::H5File& file) {
    for (const FileColumn& column : content.columns) {
      try {
        WriteColumn(column, file);
      } catch (const H5::Exception&) {
        Refuse({"convert"},
               "HDF5 cannot hold a column '{}' beside the others; write .csv, or --map it",
               Excerpt(column.name));
      }
    }
    WriteSaid(content.notes, content.doubts, file);
  });
}

}  // namespace warmjoint
