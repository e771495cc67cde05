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

void check_loading(const Problem& p) {
  const Loading& l = p.loading;
  if (!(l.stiffness >= 0) || !std::isfinite(l.stiffness))
    refuse("loading.stiffness", digits(l.stiffness), "out of range", "> 0, finite");
  if (!std::isfinite(l.velocity)) refuse("loading.velocity", digits(l.velocity), "out of range", "finite");
  if (!l.acts() || l.where == Pulled::everywhere) return;
  if (p.boundary.periodic) refuse("chain.periodic", "true", "a ring has no end to pull", "false");
  if ((l.where == Pulled::left ? p.boundary.left : p.boundary.right) == End::fixed)
    refuse(l.where == Pulled::left ? "chain.left" : "chain.right", "fixed", "the end that is pulled", "free");
}

}  // namespace

void check_implicit(const Problem& p, const Execution& execution) {
  if (execution.threads < 1) refuse("threads", std::to_string(execution.threads), "out of range", ">= 1");
  if (!p.boundary.periodic && (p.boundary.left == End::absorbing || p.boundary.right == End::absorbing))
    refuse(p.boundary.left == End::absorbing ? "chain.left" : "chain.right", "absorbing",
           "implicit steps know no absorbing ends", "free, fixed");
  if (p.friction.sticks())
    refuse("friction.law", std::string(p.friction.name()),
           "jumps at rest, which implicit steps, and so [loading], cannot follow",
           "a law without static strength, such as rate-and-state");
  if (!(p.tolerance > 0) || !(p.tolerance <= 0.1))
    refuse("chain.tolerance", digits(p.tolerance), "out of range", "> 0 and <= 0.1");
  if (!p.substrate && p.friction.contacts().ageing > 0)
    refuse("friction.contact_ageing", digits(p.friction.contacts().ageing), "there is no substrate that could age",
           "0, or interface.contact > 0");
  check_loading(p);
}

}  // namespace slipfront::chain
