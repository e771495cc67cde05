#include "scenario/text/errors.hpp"

#include <algorithm>
#include <utility>

namespace slipfront::scenario {

void Errors::throw_if_any() const {
  if (found_.empty()) return;
  std::vector<Complaint> all = found_;
  std::stable_sort(all.begin(), all.end(), [](const Complaint& a, const Complaint& b) { return a.line < b.line; });
  const Complaint first = all.front();
  all.erase(all.begin());
  throw InputError(first, std::move(all));
}

}  // namespace slipfront::scenario
