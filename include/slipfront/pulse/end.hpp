#pragma once
/// \file
/// The ends of a pulse's domain.

namespace slipfront::pulse {

/// What an end of the domain does where the stress reaches it.
enum class End {
  continued,  ///< the train goes on beyond, as it is at the end: dislocations come in and leave
  fixed,      ///< nothing passes
  free,       ///< no stress: dislocations leave, none comes in
};

}  // namespace slipfront::pulse
