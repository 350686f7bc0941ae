// Recordings in the format that their name tells: tables of text, HDF5 (one dataset a column, units as attributes), MATLAB.
#pragma once

#include <warmjoint/recording.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "models/recording/assemble.h"

namespace warmjoint {

/// Seconds that a library may take for a small file.
inline constexpr double kPatience = 30;

/// All columns of a file by their names, and the values of those that are wanted; the file is opened once. By its ending (log_formats.h).
/// Of the layout what concerns the file as a whole: names of columns, rate. patience: as of ReadApart. Throws BadInput.
FileContent ReadColumns(const std::string& path, const ReadSettings& layout,
                        const WantedColumns& wanted, double patience = kPatience);

/// The same of a table of text in memory. `name` stands for the file in messages.
FileContent ParseColumns(std::string_view text, const std::string& name, const ReadSettings& layout,
                         const WantedColumns& wanted);

/// Reads .h5 and .hdf5 as HDF5, .mat as MATLAB files, anything else as CSV, as ReadCsv does; attributes of a file count
/// where the layout has its defaults. For a process with one thread, as programs are at first. patience: as of ReadApart.
Measurements ReadRecordingFile(const std::string& path, const ReadSettings& layout = {},
                               double patience = kPatience);

/// Reads columns time, position, velocity, torque and optional motor_position, load, temperature of a table of text in any of
/// the forms that FindTable knows. A missing velocity stays empty. Throws BadInput with file:line as FindTable, FindColumns
/// and AssembleMeasurements do, for a row that lacks fields and for text in a number.
Measurements ReadCsv(const std::string& path, const ReadSettings& layout = {});

/// The recordings of a text in memory: one, or one for each episode (AssembleRecordings). `name` stands for the file in messages.
std::vector<Measurements> ParseRecordings(std::string_view text, const std::string& name,
                                          const ReadSettings& layout = {});

/// All columns of numbers or stamps (s) of a table of text, by their own names and with their units, on one clock
/// (OnOneClock). Notes name those that hold texts, which are left out. names: of all columns, in place of a header.
FileContent ParseTable(std::string_view text, const std::string& name,
                       const std::vector<std::string>& names = {});

/// The same as ParseRecordings for a text that holds one recording.
Measurements ParseCsv(std::string_view text, const std::string& name,
                      const ReadSettings& layout = {});

/// The text of a file with the columns that are present, SI, numbers that read back bit for bit.
std::string RecordingToCsv(const Measurements& measurements);

/// The datasets of an HDF5 file, with values as far as they are wanted, with their attribute
/// `unit`, and the root's `joint` ("rotary" or "linear") and `gear`. Throws BadInput, also where the wanted columns are
/// not there or have more than kMostSamples. One thread at a time. For ReadApart.
FileContent ReadHdf5Content(const std::string& path, const WantedColumns& wanted);

/// The bytes of a file with the columns that are present, SI, with those attributes. Safe to call from many threads,
/// which wait for each other: the library serves one at a time.
std::string RecordingToHdf5(const Measurements& measurements);

/// Refuses a file whose numbers lie in other files: links, external storage and virtual datasets of HDF5. Throws BadInput.
void RefuseOtherFiles(const std::string& path);

/// The text, or the bytes, of a file with these columns by their own names, with their units and what is said of them. Throws
/// BadInput for names that the format cannot hold.
std::string ColumnsToCsv(const FileContent& content);
std::string ColumnsToHdf5(const FileContent& content);

/// Throws BadInput for a name that does not end in .h5, .hdf5 or .csv.
void RequireWritable(const std::filesystem::path& path);

/// Writes columns as RequireWritable takes names. Throws BadInput, and OutputFailed; nothing half-written stays.
void WriteColumns(const FileContent& content, const std::filesystem::path& path);

/// Vectors of real numbers, with values as far as they are wanted. Those of a struct are named with a dot,
/// log.time; names without one may leave out the struct where the file holds one alone. A variable
/// `joint` ("rotary" or "linear"), a number `gear`, and texts in a struct `unit` by the columns' names count where
/// nobody says otherwise. Objects, as timeseries, cannot be read: save their Time and Data. Throws BadInput, also
/// where the wanted columns are not there. One thread at a time. For ReadApart.
FileContent ReadMatlabContent(const std::string& path, const WantedColumns& wanted);

/// Makes the recordings (AssembleRecordings) of columns, or of a table of text, as those of a file are made. name: in messages.
std::vector<Measurements> MakeRecordings(FileContent content, const ReadSettings& settings,
                                         const std::string& name);
std::vector<Measurements> MakeRecordings(std::string_view text, const ReadSettings& settings,
                                         const std::string& name);

/// Columns in memory by their names, as a file would have them.
FileContent ContentOf(const std::map<std::string, std::vector<double>>& columns);

/// Makes a recording of columns with units beside their names: what a file of them would give. name: of the recording in messages.
Measurements MakeRecording(FileContent content, const ReadSettings& settings,
                           const std::string& name);

/// A format that a library reads.
struct FileFormat {
  const char* name = "";  // in messages
  FileContent (*read)(const std::string& path, const WantedColumns& wanted) = nullptr;
};

/// Reads in a child process with limits on memory (8 GiB besides what this process has) and time
/// (patience, s, and 1 s for each 10 MB of the file): the libraries crash and hang on some damaged files, which becomes BadInput.
FileContent ReadApart(const FileFormat& format, const std::string& path,
                      const WantedColumns& wanted, double patience);

}  // namespace warmjoint
