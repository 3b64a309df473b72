#pragma once

namespace skelgen::core {

/// How high people hold a shoulder above the neck, along a trunk of length 1 from hips to neck: below it when the arm
/// is held at right angles to the trunk, higher as the arm is raised, as shoulder blade and collar bone go along
/// (ISA44), and lower beneath a head that is leant to that side. `raised`: cosine between upper arm and trunk, 1
/// overhead; `leant`: between head and the way outwards from the neck. Calibrated on 86 skeletons as found in
/// registered and landmarked bodies, of which either set alone says the same of the last two within a twentieth; the
/// first lies between theirs, .092, and the template's, .109. True shoulders are off it by .015 to .03.
template <typename Scalar>
[[nodiscard]] Scalar usual_shoulder_height(Scalar raised, Scalar leant) {
    constexpr Scalar below_neck = Scalar(0.098), higher_when_raised = Scalar(0.1), lower_beneath_head = Scalar(0.085);
    return higher_when_raised * raised - lower_beneath_head * leant - below_neck;
}

} // namespace skelgen::core
