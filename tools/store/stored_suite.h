// The suite that a run carried out.
#pragma once

#include "scenarios/suite.h"
#include "tools/store/run_store.h"

namespace warmjoint::inline tools {

/// The suite as the store holds it; RUN/suite.yaml is a copy for people, which they may edit. Throws
/// BadInput where the stored text is no suite, or its identifiers and variants are not the store's.
Suite StoredSuite(const RunStore& store);

/// Says on stderr where RUN/suite.yaml is not the stored suite any more.
void TellOfEditedSuite(const RunStore& store);

}  // namespace warmjoint::inline tools
