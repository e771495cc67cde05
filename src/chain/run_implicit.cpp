// What is particular to a run by implicit steps, and to one that is loaded.

#include "slipfront/chain/run.hpp"

namespace slipfront::chain {

/// Implicit steps to the next output. The integral of the slip velocity has a sample each.
bool Run::proceed(const std::function<bool()>& interrupted) {
  const double target = schedule_.times[snapshots_.size()] * scaled_.scale;
  while (chain_.time() < target) {
    chain_.proceed(target, 1);
    sample();
    if (interrupted && interrupted()) return false;
  }
  return true;
}

std::vector<Event> Run::events() const {
  const double c = scaled_.scale;
  std::vector<Event> events = chain_.events();
  for (Event& e : events) {
    for (double* number : {&e.onset, &e.duration, &e.slip, &e.largest_slip, &e.origin, &e.length}) *number /= c;
    if (scaled_.loading.where == Pulled::everywhere) e.stress_drop *= c;
  }
  return events;
}

}  // namespace slipfront::chain
