// Which fields a fit has, as a text.
#pragma once

#include <warmjoint/fields.h>

#include <optional>
#include <string>

#include "models/foundation/serialize.h"

namespace warmjoint {

inline constexpr const char* kWordsOfFields =
    "auto, none, or some of q,r,v,k,d,t with commas between them, each once";
/// What the option of a program says of them.
inline constexpr const char* kFieldsHelp =
    "what the model may lack, with a strength that the log decides: auto, none, or some of "
    "q,r,v,k,d,t (fields.md)";
/// The fields of such a text; nothing where it is none.
std::optional<FieldSet> FieldsIn(const std::string& text);

/// "auto", "none", or letters with commas between them.
void ReadValue(const Node& node, FieldSet* value, const FieldInfo& info);
Tree WriteValue(const FieldSet& value);

}  // namespace warmjoint
