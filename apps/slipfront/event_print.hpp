#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "events/catalogue/population.hpp"
#include "events/results/evaluate.hpp"
#include "runs/catalogue.hpp"
#include "terminal_table.hpp"

/// The parts of the results that are printed.
struct EventShown {
  bool rows = true;  ///< table rows, one per event; JSON always has rows, CSV has them unless there is a population
  bool population = false;  ///< decades of rupture velocity
  bool pulse = false;       ///< columns of a pulse through each finite-fault model
};

/// Prints results one by one as they arrive, and at the end the warnings and the population.
class EventPrinter {
 public:
  /// One event, ready to print. Any thread may make it.
  struct Printed {
    std::string row;                     ///< text of the event in JSON or CSV
    std::optional<TerminalTable> table;  ///< its rows if a table is printed
    std::string report;                  ///< the event in sentences, if it is the only one
    std::string error;
    std::vector<std::string> warnings;
    std::optional<slipfront::catalogue::Member> member;
    bool sampled = false;  ///< its values are medians of a posterior
  };

  EventPrinter(const CommonOptions& options, const EventShown& shown);
  /// `count` events arrive together with this one.
  Printed printed(const slipfront::results::EventResult& result, std::size_t count) const;
  void take(Printed&& printed);

  /// Ends the output. `written` is the file that was written, or empty.
  void finish(const slipfront::run::CatalogueColumns& columns, const std::string& written);
  std::size_t errors() const { return errors_; }

 private:
  bool is_table() const { return !options_.json && !options_.csv; }
  bool has_rows() const { return options_.json || (options_.csv ? !shown_.population : shown_.rows); }
  void print_table(const slipfront::run::CatalogueColumns& columns, const std::string& written) const;
  void print_notes(const slipfront::run::CatalogueColumns& columns) const;
  void complain_of_columns(const slipfront::run::CatalogueColumns& columns) const;

  CommonOptions options_;
  EventShown shown_;
  std::size_t count_ = 0, errors_ = 0;
  bool sampled_ = false;
  TerminalTable table_;
  std::string report_;  ///< the event in sentences, if it is the only one so far
  std::map<std::string, std::size_t> warnings_;
  slipfront::catalogue::Population population_;
};
