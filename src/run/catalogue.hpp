#pragma once
/// \file
/// The one way from texts of events to their results, for the program and the Python package: plan, run or resume.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "record/events/event_file.hpp"
#include "record/files/unfinished.hpp"
#include "results/evaluate.hpp"
#include "slipfront/catalogue/observation.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::run {

/// A file of events.
struct EventText {
  std::string name;
  std::string text;
  std::string error = {};  ///< why it could not be read; empty: it was
};

/// Events, and how each is evaluated.
struct CatalogueScenario {
  std::vector<EventText> texts;
  medium::StatedDefaults medium = {};
  results::EvaluationOptions evaluation = {};
  std::string command_line = {};  ///< history of the file
};

/// Entries of a catalogue and what its readers left out.
struct CatalogueColumns {
  std::vector<std::string> ignored;  ///< titles of columns that carry no observation
  bool unreadable = false;           ///< a file could not be read; an entry says why
};

/// All that is known of a catalogue before the work.
struct CataloguePlan {
  std::vector<catalogue::Entry> entries;  ///< with warnings where sources of one earthquake disagree
  CatalogueColumns columns;
  medium::Defaults defaults;
  results::EvaluationOptions evaluation;
  record::EventMetadata metadata;  ///< with the settings that make the results what they are
  double disk = 0;                 ///< bytes of the file, about
};
/// `with_file`: the results are to be written. \throws InputError for constants out of range and for catalogues that
/// need more memory than this process may have.
CataloguePlan plan_catalogue(const CatalogueScenario& scenario, int threads, bool with_file);

/// How a catalogue is carried out.
struct CatalogueOptions {
  record::Output output = {};  ///< NetCDF; default: none, and an interrupted catalogue is lost
  std::string resume = {};     ///< file of an interrupted catalogue; empty: begin anew
  int threads = 1;
  /// Called now and then with how many events are done, first with those of `resume`; returning true stops the
  /// catalogue. Null: it goes on to its end.
  std::function<bool(std::size_t done)> after_step = {};
};

struct CatalogueResult {
  std::vector<results::EventResult> events;  ///< of all entries, or of the first ones where it was stopped
  bool finished = false;
};

/// Evaluates all entries, in parallel, and writes them: at the start, now and then, and at the end, wherever that is.
/// Results and file have the same bits however often the work was stopped and resumed. \throws InputError if `resume`
/// is another catalogue's, FileError.
CatalogueResult catalogue(CataloguePlan&& plan, const CatalogueOptions& options);

/// Evaluates the events some at a time, in order, and hands them on: a catalogue of a million rows is never held whole.
/// \throws as plan_catalogue.
CatalogueColumns stream_catalogue(const CatalogueScenario& scenario, int threads,
                                  const std::function<void(std::vector<results::EventResult>&&)>& take);

}  // namespace slipfront::run
