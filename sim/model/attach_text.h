// Attaching without writing: for commands that put several outputs in place together.
#pragma once

#include <warmjoint/attach.h>

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint {

/// What AttachFriction writes to a file, before it is written.
struct AttachedText {
  Attached attached;
  std::string xml;  // MJCF that loads from where `out` will lie
};

/// AttachFriction of a model in a file, without writing: the text for `out`.
AttachedText AttachFrictionAsText(const std::filesystem::path& model,
                                  const std::vector<FrictionForJoint>& frictions,
                                  const std::filesystem::path& out,
                                  const AttachOptions& options = {});

}  // namespace warmjoint
