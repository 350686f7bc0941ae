// The border of the public interface: errors of the rooms become its own.
#pragma once

#include <warmjoint/recording.h>

#include <filesystem>

#include "models/foundation/bad_input.h"
#include "models/foundation/output_failed.h"

namespace warmjoint::api {

/// What `work` returns; refusals and failed outputs of the rooms are thrown as the interface's.
template <typename Work>
auto Guarded(const Work& work) {
  try {
    return work();
  } catch (const models::BadInput& error) {
    throw BadInput(error.what());
  } catch (const models::OutputFailed& error) {
    throw OutputFailed(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    // a name that the system takes for none, or a folder that cannot be entered
    throw BadInput(error.path1().string() + ": cannot be used: " + error.code().message());
  }
}

}  // namespace warmjoint::api
