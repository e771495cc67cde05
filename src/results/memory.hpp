#pragma once
/// \file
/// Estimates the memory and the disk space that the events of a catalogue need.

#include <cstddef>

#include "results/evaluate.hpp"

namespace slipfront::results {

/// Bytes of memory to evaluate `events` events, `at_once` of them at a time, and to store their results.
double memory_needed(const EvaluationOptions& options, std::size_t events, int at_once);
/// Bytes of the file of these results, which is created in memory.
double disk_needed(const EvaluationOptions& options, std::size_t events);
/// \throws InputError if this needs more memory than this process may have. The error states both numbers.
void require_memory(const EvaluationOptions& options, std::size_t events, int at_once, bool with_file = false);

}  // namespace slipfront::results
