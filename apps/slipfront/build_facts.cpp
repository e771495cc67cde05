#include "build_facts.hpp"

#include <fmt/core.h>

#include <CLI/Version.hpp>
#include <boost/version.hpp>

#include "installed.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "system/ranks.hpp"

Json build_facts() {
  Json facts;
  facts["slipfront"] = SLIPFRONT_VERSION;
  facts["compiler"] = __VERSION__;
  facts["boost"] = fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
  facts["cli11"] = CLI11_VERSION;
  facts["fmt"] = fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
  facts["nlohmann_json"] =
      fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
  facts["netcdf"] = slipfront::record::netcdf::library_version();
  facts["mpi"] = slipfront::Ranks::available();
  facts["python"] = python_interpreter();
  return facts;
}
