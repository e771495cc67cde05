#pragma once

#include <string>
#include <vector>

#include "slipfront/record/event_file.hpp"
#include "slipfront/record/unfinished.hpp"
#include "slipfront/results/evaluate.hpp"

/// A catalogue that is written to a file while it is evaluated.
struct EventKeeping {
  slipfront::record::Output output;  ///< NetCDF; none: an interrupted catalogue is lost
  std::string resume;                ///< what an earlier call wrote; empty: begin anew
  slipfront::record::EventMetadata metadata;
  int threads = 1;
  bool quiet = false;
};

struct KeptEvents {
  std::vector<slipfront::results::EventResult> results;  ///< of all entries, or of the first if not `finished`
  bool finished = false;                                 ///< else Ctrl-C came first; the file holds what was done
};

/// Evaluates all entries, in parallel, with a line of progress on a terminal and a checkpoint now and then. The results
/// and the file have the same bits however often the work was stopped and resumed. \throws InputError if `resume` is
/// another catalogue's, FileError.
KeptEvents evaluate_and_keep(std::vector<slipfront::catalogue::Entry>&& entries,
                             const slipfront::medium::Defaults& defaults,
                             const slipfront::results::EvaluationOptions& plan, const EventKeeping& keeping);
