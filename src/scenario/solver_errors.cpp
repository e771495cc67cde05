#include "scenario/solver_errors.hpp"

#include <string_view>

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

}  // namespace slipfront::scenario
