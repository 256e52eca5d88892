#pragma once

#include <filesystem>

#include "experiments/session/study.h"

namespace plenolab {

/// A study to try and to change: five images and a catch trial, two blocks (light-field display, then
/// monitor, and the other way round for every second participant), consent, questions. Texts are placeholders
/// that say so.
StudyDefinition example_study();

/// Draws the images of example_study into `folder`: for the light-field display 15 × 8 subimages of 81 × 81
/// px of discs floating before a wall, for the monitor the central subimage (row 4, column 8). In the test
/// images what lies beside a disc's edge is a mean colour, in a band that widens from image to image, as
/// holes of reprojection look.
void write_example_images(const std::filesystem::path& folder);

/// The study of an image set: pairs NAME-reference.png and NAME-test.png in `images`, and for the monitor
/// NAME-monitor-reference.png and NAME-monitor-test.png where they are. Copies them into `folder`/images.
/// Throws InputError if there is no pair.
StudyDefinition study_of_images(const std::filesystem::path& images, const std::filesystem::path& folder);

}  // namespace plenolab
