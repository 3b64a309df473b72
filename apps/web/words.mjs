// What the page says in sentences: errors, what was tried, warnings.

/// What to do about a mesh in which no body was found, by the code of the refusal.
const advice = {
  several_bodies: "Choose one of the bodies below, or export each as a file of its own.",
  nothing_enclosed: "Close its surface, or export the whole body and not parts of it.",
  too_compact: "Export the character alone, with arms and legs that stand off the trunk.",
  too_few_ends: "Spread arms and legs a little, take away skirts and robes, and export again.",
  too_many_ends: "Close holes and remove loose pieces, or simplify the mesh, and export again.",
  curve_in_pieces: "Join the character's pieces, or export it without what floats beside it.",
  flat_trunk: "Export a body with some thickness: a flat figure has no left and right.",
  no_mirror: "Export the character in a plain pose, as T or A, without what it holds.",
  unlikely: "Export it in a plain pose, as T or A, without robe, cape or seat, and try again.",
};

/// The same of files, by the code of the error.
const file_advice = {
  bad_input: "Export the character again, best as GLB, and drop that.",
  out_of_memory: "Simplify the mesh to some hundred thousand faces and drop it again.",
  internal: "The page goes on; try another file, and please report this one.",
  usage: "Try again, or choose another setting.",
};

const sentence = (text) => {
  const trimmed = text.trim();
  const upper = trimmed.charAt(0).toUpperCase() + trimmed.slice(1);
  return /[.!?]$/.test(upper) ? upper : `${upper}.`;
};

/// What went wrong with a file, and what to do.
export function told_error(name, { code, message, refusal }) {
  if (code === "no_skeleton")
    return {
      title: `No body was found in ${name}`,
      reason: sentence(message),
      advice: advice[refusal] ?? "Export it in a plain pose, as T or A, and try again.",
    };
  // Messages go on after the file's name, and most say what to do: "is empty; export it again".
  if (/known format/.test(message))
    return { title: `${name} cannot be used`, reason: "It is no mesh that is known here.", advice: "Drop a GLB, VRM, glTF, OBJ, PLY, STL or OFF." };
  const [what, ...todo] = message.split("; ");
  const goes_on = /^(is|has|have|holds|cannot|needs|ends|lacks|contains|shows)\b/.test(what);
  return {
    title: `${name} cannot be used`,
    reason: sentence(goes_on ? `It ${what}` : `It could not be read: ${what}`),
    advice: todo.length > 0 ? sentence(todo.join("; ")) : file_advice[code] ?? file_advice.bad_input,
  };
}

const surfaces = {
  largest_piece: "the largest piece", rounded: "the largest piece made rounder", envelope: "an envelope around all",
  alike_pieces: "an envelope without lone pieces", bridged: "an envelope with bridged gaps",
};
const curves = {
  draft: "a curve", detailed: "a curve with tails and horns", more_detailed: "a finer curve with tails and horns",
  rest_fit: "a body at rest laid in", posed_fit: "bodies in any pose laid in",
};
const outcomes = {
  found: "a skeleton", too_few_ends: "too few limbs", too_many_ends: "too many ends", curve_in_pieces: "a curve in pieces",
  too_compact: "too compact", flat_trunk: "a flat trunk", no_mirror: "no two like halves", unlikely: "an unlikely skeleton",
  nothing_enclosed: "nothing enclosed", several_bodies: "several bodies", none: "nothing",
};
const spaced = (code) => String(code).replaceAll("_", " ");

/// One try of the search, in words.
export function told_try({ surface, curve, outcome, probability, seconds }) {
  const what = [surfaces[surface] ?? spaced(surface), curves[curve] ?? spaced(curve)];
  const came = outcome === "found" ? `${outcomes.found}, right with ${percent(probability)}` : outcomes[outcome] ?? spaced(outcome);
  return `${sentence(what.join(", ")).slice(0, -1)}: ${came} (${seconds < 0.095 ? "under 0.1" : seconds.toFixed(1)} s)`;
}

export const percent = (part) => `${Math.round(100 * part)} %`;

/// How sure it is, as a sentence.
export function told_confidence(confidence) {
  if (confidence >= 0.9) return "Very likely right.";
  if (confidence >= 0.5) return "Probably right; look at it.";
  return "A guess: look at it, and move the joints that are wrong.";
}

export const told_joint = (name) => spaced(name);
export { sentence };
