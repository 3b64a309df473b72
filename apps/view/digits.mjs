// Joints of fingers and toes, by their names, and what curls them all.
const digit = /^(left|right)_(?:(thumb|index|middle|ring|little)|toe[1-5])_[1-3]$/;
const limb = /^(left|right)_(?:(wrist|hand)|foot)$/;

/// Whose digits a joint is one of, or carries: left_hand, right_foot; null where it is none of either.
const extremity = (found) => found && `${found[1]}_${found[2] ? "hand" : "foot"}`;

export const is_digit = (name) => digit.test(name);

/// What there is of them among joints: fingers, toes.
export const kinds_of_digits = (joints) =>
  [...new Set(joints.filter(({ name }) => is_digit(name)).map(({ name }) => (name.includes("_toe") ? "toes" : "fingers")))];

/// The joints of all digits beside a joint, with how far each turns where all are curled: the thumb half as far.
export function digits_beside(joints, name) {
  const own = extremity(digit.exec(name) ?? limb.exec(name));
  return joints.filter((joint) => own && extremity(digit.exec(joint.name)) === own)
    .map((joint) => ({ name: joint.name, share: joint.name.includes("thumb") ? 0.5 : 1 }));
}
