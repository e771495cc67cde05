#include "scenario/solver_errors.hpp"

#include <cctype>
#include <charconv>
#include <string_view>

#include "math/digits.hpp"

namespace slipfront::scenario {
namespace {

struct ProblemPart {
  SolverKind solver;
  std::string_view name, key;
  std::string_view other_command = {};  ///< runs the problems that this solver refuses because of this part
};

constexpr std::string_view chain_command = "slipfront chain", direct_command = "slipfront plane --direct";
constexpr ProblemPart problem_parts[] = {
    {SolverKind::pulse, "stress", "initial"},
    {SolverKind::pulse, "contact", "interface.contact"},
    {SolverKind::pulse, "periodic", "pulse.periodic", chain_command},
    {SolverKind::chain, "contact", "interface.contact"},
    {SolverKind::chain, "contact ageing", "friction.contact_ageing"},
    {SolverKind::chain, "friction", "friction.law"},
    {SolverKind::chain, "left end", "chain.left"},
    {SolverKind::chain, "right end", "chain.right"},
    {SolverKind::chain, "periodic", "chain.periodic"},
    {SolverKind::chain, "spacing", "chain.spacing"},
    {SolverKind::chain, "precision", "chain.precision"},
    {SolverKind::plane, "slip", ""},
    {SolverKind::plane, "hold", "initial.hold", direct_command},
    {SolverKind::plane, "friction", "friction.law", direct_command},
    {SolverKind::plane, "nucleation", "nucleation", direct_command},
    {SolverKind::plane, "edges", "plane.edges", direct_command},
    {SolverKind::plane, "fixed", "plane.fixed"},
    {SolverKind::plane, "left", "plane.left"},
    {SolverKind::plane_direct, "slip", ""},
    {SolverKind::plane_direct, "friction", "friction.law"},
    {SolverKind::plane_direct, "scale", "chain.scale"},
    {SolverKind::plane_direct, "spacing", "chain.spacing"},
};

}  // namespace

InputError in_keys(SolverKind solver, const std::string& file, const InputError& error, const char* slip_key) {
  Complaint complaint = error.complaint();
  if (!complaint.file.empty()) return error;
  for (const ProblemPart& part : problem_parts) {
    if (part.solver != solver || part.name != complaint.key) continue;
    complaint.file = file;
    complaint.key = part.name == "slip" ? slip_key : part.key;
    if (!part.other_command.empty())
      complaint.allowed += (complaint.allowed.empty() ? "" : ", or ") + std::string(part.other_command);
    return InputError(complaint);
  }
  return error;
}

namespace {

/// A number in a message, such as "t = 2.5".
struct NumberIn {
  std::size_t begin, end;
  double value;
  bool is_time;
};

/// The first "t = ", "x = " or "y = " at or after `from` with a number that is not 0 and has no unit.
std::optional<NumberIn> number_in(std::string_view text, std::size_t from) {
  for (std::size_t at = text.find(" = ", from); at != std::string_view::npos; at = text.find(" = ", at + 1)) {
    const bool is_name = at > 0 && std::string_view("txy").find(text[at - 1]) != std::string_view::npos;
    if (!is_name || (at > 1 && std::isalnum(static_cast<unsigned char>(text[at - 2])) != 0)) continue;
    const std::size_t begin = at + 3;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data() + begin, text.data() + text.size(), value);
    const auto after = static_cast<std::size_t>(end - text.data());
    const bool is_time = text[at - 1] == 't';
    if (error != std::errc() || value == 0 || text.substr(after).starts_with(is_time ? " s" : " m")) continue;
    return NumberIn{begin, after, value, is_time};
  }
  return std::nullopt;
}

}  // namespace

std::string Scenario::in_results(double value, std::string_view unit) const {
  if (!results_in) return digits(value);
  const medium::UnitInSi si = results_in->of(unit);
  return digits(value * si.value) + " " + std::string(si.name);
}

std::string in_results(std::string_view message, const std::optional<medium::SiUnits>& units) {
  if (!units) return std::string(message);
  const double second = units->of("b / (c A)").value, metre = units->of("b / A").value;
  std::string text;
  std::size_t done = 0;
  for (auto found = number_in(message, 0); found; found = number_in(message, done)) {
    text += message.substr(done, found->begin - done);
    text += found->is_time ? digits(found->value * second) + " s" : digits(found->value * metre) + " m";
    done = found->end;
  }
  return text.append(message.substr(done));
}

}  // namespace slipfront::scenario
