#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "batch.hpp"
#include "build_facts.hpp"
#include "commands.hpp"
#include "installed.hpp"
#include "json.hpp"
#include "terminal_table.hpp"

namespace {

/// A part of slipfront on this machine.
struct Check {
  std::string name, use;
  bool works = false;
  std::string found;   ///< version or folder; empty if it does not work
  std::string remedy;  ///< how to make it work; empty if nothing is missing
};

struct Library {
  const char *module, *use, *debian;
};
constexpr std::array<Library, 7> libraries = {{
    {"numpy", "arrays", "python3-numpy"},
    {"xarray", "results in Python", "python3-xarray"},
    {"netCDF4", "files in xarray", "python3-netcdf4"},
    {"matplotlib", "plot, animate and reproduce", "python3-matplotlib"},
    {"distributed", "sweeps on a Dask cluster", "python3-distributed"},
    {"emcee", "population", "python3-emcee"},
    {"scipy", "population", "python3-scipy"},
}};

/// Prints "name version" for Python and for each module in its arguments that works. Debian's modules do not all know
/// their own version. Each line is printed at once, because a module may end the process.
constexpr const char* print_versions = R"(
import importlib, importlib.metadata, sys
print("Python", sys.version.split()[0], flush=True)
for name in sys.argv[1:]:
    try:
        importlib.import_module(name)
        print(name, importlib.metadata.version(name), flush=True)
    except BaseException:
        pass
)";

/// The versions of Python and of the libraries that work, by name.
std::map<std::string, std::string> python_versions() {
  setenv("SLIPFRONT_PYTHON", python_interpreter().c_str(), 1);  // so that the shell need not quote it
  std::string command = std::string("PYTHONSAFEPATH=1 exec \"$SLIPFRONT_PYTHON\" -c '") + print_versions + "'";
  for (const Library& library : libraries) command += std::string(" ") + library.module;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>/dev/null </dev/null").c_str(), "r"), pclose);
  std::map<std::string, std::string> versions;
  std::array<char, 256> line{};
  while (pipe && std::fgets(line.data(), line.size(), pipe.get())) {
    std::string_view text = line.data();
    if (text.ends_with('\n')) text.remove_suffix(1);
    if (const std::size_t blank = text.find(' '); blank != std::string_view::npos)
      versions.emplace(text.substr(0, blank), text.substr(blank + 1));
  }
  return versions;
}

Check check_of(const Library& library, const std::string& version) {
  return {library.module, library.use, !version.empty(), version,
          fmt::format("apt-get install {}, or pip install {}", library.debian, library.module)};
}

std::vector<Check> all_checks() {
  const Json facts = build_facts();
  std::map<std::string, std::string> versions = python_versions();
  const std::string version = versions["Python"];
  const std::filesystem::path package = package_folder();
  const std::string page = shipped_page();
  const bool has_mpi = facts["mpi"].get<bool>();
  std::vector<Check> checks = {
      {"NetCDF", "output files", true, facts["netcdf"].get<std::string>(), ""},
      {"MPI", "chains over several processes (mpirun)", has_mpi, has_mpi ? "built in" : "",
       "install libopenmpi-dev and openmpi-bin, and build again"},
      {"explorer", "slipfront explore", !page.empty(), page, "build it with ./run explore"},
      {"Python", "plot, animate and reproduce", !version.empty(), version, "apt-get install python3"},
      {"slipfront", "the Python package of this program", !package.empty(), package.string(),
       "apt-get install python3-slipfront, or pybind11-dev and build again"},
  };
  for (const Library& library : libraries) checks.push_back(check_of(library, versions[library.module]));
  return checks;
}

int run_doctor(bool json, bool wide) {
  if (wide) print_whole_lines();
  const std::vector<Check> checks = all_checks();
  if (json) {
    Json all;
    all["build"] = build_facts();
    for (const Check& check : checks)
      all["checks"].push_back({{"name", check.name},
                               {"use", check.use},
                               {"works", check.works},
                               {"found", check.found},
                               {"remedy", check.works ? "" : check.remedy}});
    put(text_of(all) + "\n");
    return exit_done;
  }
  put(fmt::format("slipfront {}\n", SLIPFRONT_VERSION));
  for (const Check& check : checks)
    put(fitted(fmt::format("{:<12} {:<8} {}: {}", check.name, check.works ? "works" : "missing", check.use,
                           check.works ? check.found : check.remedy),
               12 + 1 + 8 + 1));
  return exit_done;
}

}  // namespace

Runner add_doctor(CommandLine& program) {
  CommandLine command = program.command("doctor", "What works on this machine, and what to install for the rest",
                                        {"slipfront doctor", "slipfront doctor --json"});
  auto json = std::make_shared<bool>(false), wide = std::make_shared<bool>(false);
  command.flag("--json", *json, "One JSON object on stdout, nothing else");
  add_wide(command, *wide);
  return [json, wide] { return run_doctor(*json, *wide); };
}
