#pragma once
/// \file
/// Evaluates texts of events: plans, runs or resumes a catalogue. The program and the Python package both use this
/// file.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "events/results/evaluate.hpp"
#include "runs/record/events/event_file.hpp"
#include "slipfront/events/catalogue/observation.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "slipfront/theory/medium/constants.hpp"
#include "system/files/whole_file.hpp"

namespace slipfront::run {

/// The text of a file of events.
struct EventText {
  std::string name;
  std::string text;
  std::string error = {};   ///< why the file could not be read; empty if it was read
  std::string folder = {};  ///< its texts are sources of one event; empty for a file that the user names
};

/// The text of a file, or those of all files in a folder. \throws FileError if there are none.
std::vector<EventText> texts_of(const std::string& path);

/// Events, and how each is evaluated.
struct CatalogueScenario {
  std::vector<EventText> texts;
  catalogue::TableOptions table = {};  ///< how CSV files are read
  bool strict =
      false;  ///< refuse a file with a bad row, or with a column that looks like a quantity and is not understood
  medium::StatedDefaults medium = {};
  results::EvaluationOptions evaluation = {};
  std::string command_line = {};  ///< stored as the history of the output file
};

/// The columns of one file that were not read.
struct FileNotes {
  std::string file;
  catalogue::TableNotes table;
};

/// The columns of a catalogue that were not read, and whether a file could not be read at all.
struct CatalogueColumns {
  std::vector<FileNotes> files;                 ///< the files with notes
  std::vector<std::string> ignored;             ///< titles of columns without observations, of all files
  std::vector<std::string> ignored_quantities;  ///< those of them that look like quantities
  bool unreadable = false;                      ///< a file could not be read; an entry has the reason
};

/// A catalogue that has been read and checked, but not evaluated.
struct CataloguePlan {
  std::vector<catalogue::Entry> entries;  ///< with warnings if sources of one earthquake disagree
  CatalogueColumns columns;
  medium::Defaults defaults;
  results::EvaluationOptions evaluation;
  record::EventMetadata metadata;  ///< with the settings on which the results depend
  double disk = 0;                 ///< approximate number of bytes of the file
};
/// Reads and checks a catalogue. Set `with_file` if its results will be written to a file. \throws InputError for
/// constants out of range, and for catalogues that need more memory than this process may have.
CataloguePlan plan_catalogue(const CatalogueScenario& scenario, int threads, bool with_file);

/// How to run a catalogue.
struct CatalogueOptions {
  record::Output output = {};  ///< NetCDF file; by default none, and an interrupted catalogue is lost
  std::string resume = {};     ///< file of an interrupted catalogue; empty: start from the beginning
  int threads = 1;
  /// A function that the catalogue calls from time to time with the number of finished events, first with that of
  /// `resume`. Return true to stop the catalogue. If it is null, the catalogue runs to its end.
  std::function<bool(std::size_t done)> after_step = {};
};

struct CatalogueResult {
  std::vector<results::EventResult> events;  ///< all events, or the first ones if the catalogue was stopped
  bool finished = false;
};

/// Evaluates all entries in parallel. It writes the file at the start, from time to time, and when the catalogue stops.
/// Stopping and resuming do not change a bit of the results or of the file. \throws InputError if `resume` is the file
/// of another catalogue, FileError.
CatalogueResult catalogue(CataloguePlan&& plan, const CatalogueOptions& options);

/// Evaluates the events in order, some at a time, and passes them to `take`, so that not all results are in memory at
/// once. \throws as plan_catalogue.
CatalogueColumns stream_catalogue(const CatalogueScenario& scenario, int threads,
                                  const std::function<void(std::vector<results::EventResult>&&)>& take);

}  // namespace slipfront::run
