#include "results/serialize.hpp"

#include <cstdint>
#include <type_traits>
#include <utility>

#include "foundation/bytes.hpp"

namespace slipfront::results {

using finite_fault::FaultPulse;
using inference::Posterior;
using inference::Prediction;
using inference::Tension;

namespace {

/// Both directions go through the same members in the same order: `walk`.
template <class Io, class P>
void walk_posterior(Io& io, P& p) {
  for (const inference::Quantity& q : inference::quantities()) io(p.*q.quantiles);
  io(p.friction_identified), io(p.contact_ratio_prior_share), io(p.damping_number_prior_share);
  io(p.trade_off), io(p.tension), io(p.predictions), io(p.contradicted), io(p.draws), io(p.prior_draws), io(p.repeated),
      io(p.notes);
  io(p.suffices), io(p.effective_samples), io(p.pareto_k), io(p.samples), io(p.seed);
}

template <class Io, class T>
void walk_tension(Io& io, T& t) {
  io(t.observation), io(t.sigmas);
  for (const inference::Quantity& q : inference::quantities()) io(t.without.*q.quantiles);
}

class Put {
 public:
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    out_.put(value);
  }
  void operator()(const std::string& text) { each(text); }
  void operator()(const Posterior& p) { walk_posterior(*this, p); }
  void operator()(const Tension& t) { walk_tension(*this, t); }
  void operator()(const Prediction& p) { (*this)(p.observation), (*this)(p.below); }
  void operator()(const FaultPulse& p) { visit_members(*this, p); }
  template <class T>
  void operator()(const std::optional<T>& value) {
    out_.put(static_cast<char>(value.has_value()));
    if (value) (*this)(*value);
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    each(values);
  }
  std::string text() && { return std::move(out_).text(); }

 private:
  template <class Values>
  void each(const Values& values) {
    out_.put(static_cast<std::uint64_t>(values.size()));
    for (const auto& value : values) (*this)(value);
  }
  bytes::Writer out_;
};

class Get {
 public:
  explicit Get(std::string_view text) : in_(text) {}
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
    value = in_.get<T>();
  }
  void operator()(bool& value) { value = in_.get<char>() != 0; }
  void operator()(std::string& text) { each(text); }
  void operator()(Posterior& p) { walk_posterior(*this, p); }
  void operator()(Tension& t) { walk_tension(*this, t); }
  void operator()(Prediction& p) { (*this)(p.observation), (*this)(p.below); }
  void operator()(FaultPulse& p) { visit_members(*this, p); }
  template <class T>
  void operator()(std::optional<T>& value) {
    value.reset();
    if (in_.get<char>() != 0) (*this)(value.emplace());
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    each(values);
  }
  bool at_end() const { return in_.at_end(); }

 private:
  /// One by one: a size that is wrong ends with the bytes, not with the memory.
  template <class Values>
  void each(Values& values) {
    for (auto left = in_.get<std::uint64_t>(); left > 0; --left) {
      values.push_back({});
      (*this)(values.back());
    }
  }
  bytes::Reader in_;
};

}  // namespace

std::string serialize(std::span<const EventResult> results) {
  Put put;
  for (const EventResult& r : results) put(r.posterior), put(r.pulse), put(r.error);
  return std::move(put).text();
}

std::vector<SavedResult> deserialize(std::string_view saved) {
  std::vector<SavedResult> all;
  for (Get get(saved); !get.at_end();) {
    SavedResult& found = all.emplace_back();
    get(found.posterior), get(found.pulse), get(found.error);
  }
  return all;
}

}  // namespace slipfront::results
