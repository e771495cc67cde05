#pragma once
/// \file
/// What this machine has for one process.

namespace slipfront {

/// Bytes of memory: of the machine, of the control groups that hold this process, and of its own limit, whichever is
/// least. Infinity where nothing is known.
double usable_memory();

/// `wanted` threads, but no more than can be of use: many that do nothing take memory, and the OpenMP runtime ends the
/// program when one cannot be started.
int sensible_threads(int wanted);

}  // namespace slipfront
