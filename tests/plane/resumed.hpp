#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/problem.hpp"
#include "system/archive.hpp"

/// Expects that a solver that continues from the state of another gives the bits of one that never stopped, and that
/// `other`, a solver of other cells, refuses this state.
template <class Make>
void expect_the_same_bits_when_resumed(const Make& make, slipfront::plane::Solver& other) {
  const auto whole = make(), part = make(), resumed = make();
  whole->advance_to(0.5, {});
  part->advance_to(0.5, [] { return true; });  // one step
  EXPECT_LT(part->time(), 0.5);
  slipfront::restore(*resumed, slipfront::saved(*part));
  EXPECT_TRUE(resumed->advance_to(0.5, {}));
  EXPECT_EQ(resumed->steps(), whole->steps());
  EXPECT_EQ(slipfront::saved(*resumed), slipfront::saved(*whole));
  EXPECT_THROW(slipfront::restore(other, slipfront::saved(*part)), slipfront::InputError);
}
