#pragma once
/// \file
/// What the events of a catalogue need of memory and disk.

#include <cstddef>

#include "results/evaluate.hpp"

namespace slipfront::results {

/// Bytes that it takes to evaluate `events` events, `at_once` of them at a time, and to keep their results.
double memory_needed(const EvaluationOptions& options, std::size_t events, int at_once);
/// Bytes of a file of them, which is made in memory.
double disk_needed(const EvaluationOptions& options, std::size_t events);
/// \throws InputError, which says both, if that is more memory than this process may have.
void require_memory(const EvaluationOptions& options, std::size_t events, int at_once, bool with_file = false);

}  // namespace slipfront::results
