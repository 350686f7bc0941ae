// What verdicts ask and assume, in words for those who never saw warmjoint.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace warmjoint::figures {

/// The question that a test for lack of fit asks; its name where it is not known.
std::string QuestionOf(const std::string& test);

/// What helps where the answer is yes: another model, or another log.
std::string RemedyOf(const std::string& test);

/// What an assumption takes for granted.
std::string AssumptionOf(const std::string& name);

/// Terms of a page with their meaning.
const std::vector<std::pair<std::string, std::string>>& Terms();

}  // namespace warmjoint::figures
