#pragma once

#include <string>
#include <vector>

#include "experiments/session/form.h"
#include "experiments/session/study.h"

namespace plenolab {

/// The pages of a session besides its trials.

/// Whether the participant is of age; decides whose consent is needed.
FormQuestion adult_question(const ConsentText& consent);
bool answers_minor(const ConsentText& consent, const std::string& answer);

/// Consent of participant or guardian, and the name under it.
FormQuestion consent_question(const std::string& id, const std::string& text);
bool answers_agreed(const std::string& answer);
FormQuestion signature_question(const std::string& id, const std::string& whose);

/// Questions about the person, in order.
std::vector<FormQuestion> person_questions(const Demographics& asked);
/// Whether this is the answer of a far-sighted participant, whose session ends there.
bool answers_far_sighted(const std::string& answer);

/// How a trial goes, in the words of the study or in ours if it has none.
FormQuestion instruction_page(const StudyDefinition& study);
FormQuestion block_page(const StudyDefinition& study, const StudyBlock& block, int position, int count);
std::vector<FormQuestion> closing_questions(const StudyDefinition& study);
FormQuestion message(const std::string& id, const std::string& text);

}  // namespace plenolab
