#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "event_print.hpp"
#include "slipfront/event/evaluate.hpp"
#include "slipfront/event/read.hpp"

/// How events were asked for.
struct EventArguments {
  CommonOptions common;
  std::vector<std::string> files;
  slipfront::event::StatedMedium medium;
  std::optional<std::size_t> samples;
  std::uint64_t seed = 1;
  std::string closure = "consistent";
  bool pulse = false, population = false;
  std::string output, resume;
};

slipfront::event::Plan plan_of(const EventArguments& arguments);

/// Reads all files; what cannot be read is an entry with the reason. `with_text` is given each file's name and text.
struct EventsRead {
  std::vector<std::string> ignored_columns;
  bool unreadable = false;
};
EventsRead read_all(const EventArguments& arguments, const slipfront::event::Sink& sink,
                    const std::function<void(std::string_view, std::string_view)>& with_text);

int exit_code(const EventsRead& read, const EventPrinter& printer);

/// Events that are printed only: some at a time, so that a catalogue of a million rows is never held whole.
int print_events(const EventArguments& arguments);

/// Events that are written to a file. \throws InputError, FileError.
int write_events(const EventArguments& arguments);
