#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "event_print.hpp"
#include "slipfront/catalogue/read.hpp"
#include "slipfront/results/evaluate.hpp"

/// How events were asked for.
struct EventArguments {
  CommonOptions common;
  std::vector<std::string> files;
  slipfront::medium::StatedDefaults medium;
  std::optional<std::size_t> samples;
  std::uint64_t seed = 1;
  std::string closure = "consistent";
  bool pulse = false, population = false;
  std::string output, resume;
  std::size_t draws = 0;
};

slipfront::results::EvaluationOptions plan_of(const EventArguments& arguments);

/// A file of events, as text.
struct EventText {
  std::string name;
  std::string text;
  std::string error;  ///< why it could not be read; empty: it was
};
std::vector<EventText> texts_of(const EventArguments& arguments);

/// The entries of all files; of one that cannot be read, an entry with the reason.
struct EventsRead {
  std::vector<std::string> ignored_columns;
  bool unreadable = false;
};
EventsRead read_all(const EventArguments& arguments, const std::vector<EventText>& texts,
                    const slipfront::catalogue::Sink& sink);

int exit_code(const EventsRead& read, const EventPrinter& printer);

/// Events that are printed only: some at a time, so that a catalogue of a million rows is never held whole.
int print_events(const EventArguments& arguments);

/// Events that are written to a file. \throws InputError, FileError.
int write_events(const EventArguments& arguments);
