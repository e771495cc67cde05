#include "chain/implicit/check_implicit.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "foundation/text/digits.hpp"
#include "friction/state/contacts.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

void refuse(const char* key, std::string value, const char* problem, const char* allowed) {
  throw InputError({.key = key, .value = std::move(value), .problem = problem, .allowed = allowed});
}

void check_pulled_end(const Problem& p) {
  const Loading& l = p.loading;
  if (!l.acts() || l.where == Pulled::everywhere) return;
  const bool left = l.where == Pulled::left;
  if (p.boundary.periodic) refuse("periodic", "true", "a ring has no end to pull", "false");
  if ((left ? p.boundary.left : p.boundary.right) == End::fixed)
    refuse(left ? "left end" : "right end", "fixed", "the end that is pulled", "free");
}

}  // namespace

void check_implicit(const Problem& p, const Execution& execution) {
  if (execution.threads < 1) refuse("threads", std::to_string(execution.threads), "out of range", ">= 1");
  if (!p.boundary.periodic && (p.boundary.left == End::absorbing || p.boundary.right == End::absorbing))
    refuse(p.boundary.left == End::absorbing ? "left end" : "right end", "absorbing",
           "implicit steps know no absorbing ends", "free, fixed");
  if (p.friction.sticks())
    refuse("friction", std::string(p.friction.name()),
           "jumps at rest, which implicit steps, and so springs, cannot follow",
           "a law without static strength, such as rate-and-state");
  if (!p.substrate && p.friction.contacts().ageing > 0)
    refuse("contact ageing", digits(p.friction.contacts().ageing), "there is no substrate that could age",
           "0, or a contact > 0");
  check_pulled_end(p);
}

}  // namespace slipfront::chain
