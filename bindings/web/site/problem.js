// Errors of the library in words for people: what is wrong, why, what to do.

/** Number of letters by which two words differ. */
function distance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, k) => k);
  for (let i = 1; i <= a.length; i += 1) {
    const next = [i];
    for (let j = 1; j <= b.length; j += 1)
      next.push(Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1)));
    row = next;
  }
  return row[b.length];
}

const upper = (text) => text.charAt(0).toUpperCase() + text.slice(1);
const sentence = (text) => upper(text.trim()) + (/[.?!]$/.test(text.trim()) ? "" : ".");

/** Words for a key that a scene does not have, or for a word that is no choice there. */
function unknown(kind, word, words) {
  const [nearest] = [...words].sort((a, b) => distance(a, word) - distance(b, word));
  const guess = nearest && distance(nearest, word) <= Math.max(2, word.length / 3) ? ` Did you mean “${nearest}”?` : "";
  const [what, all] = kind === "key" ? ["A scene has", "Keys"] : ["There is", "Words"];
  return `${what} no ${kind} “${word}” here.${guess}\n${all} that can stand here: ${words.join(", ")}.`;
}

/** Words for what the reader of the text stumbles over. */
function unreadable(message) {
  const line = /at line (\d+)/.exec(message)?.[1];
  const quoted = /\n\s*\d+ \| (.*)\n/.exec(message)?.[1]?.trim();
  const reason = (message.split(/\|\s*\^+/).at(-1) ?? message).replace(/[\s.]*Correct this entry\.?\s*$/, "").trim();
  const start = line ? `Line ${line}${quoted ? ` (${quoted})` : ""} cannot be read. ` : "The text cannot be read. ";
  const field = /unknown (key|choice) `([^`]*)`, expected (?:one of )?(.*)/s.exec(reason);
  if (field) return start + unknown(field[1], field[2], [...field[3].matchAll(/`([^`]*)`/g)].map(([, word]) => word));
  const type = /^(string|boolean|integer|floating point) (.*?), expected (.*)/s.exec(reason);
  if (type) {
    const found = { string: "the text ", boolean: "" }[type[1]] ?? "the number ";
    const wanted = type[3] === "a boolean" ? "true or false" : type[3];
    return `${start}It has ${found}${type[2].replaceAll("`", "")}. Give ${wanted} instead.`;
  }
  if (/key with no value/.test(reason)) return `${start}A key needs a value. Write: key = value.`;
  if (/unclosed/.test(reason)) return `${start}A bracket or a quotation mark is not closed. Close it.`;
  return start + sentence(reason);
}

/** Words of the library, and those of the page. */
const WORDS = [
  [/^at time ([\d.e+-]+) /, (_, time) => `at t = ${Number(Number(time).toFixed(2))}, `],
  [/ \(steps as short as[^)]*\)/g, ""],
  [/ \(with a grid, a finer one\)/g, ""],
  [/, between markers \d+ and \d+/g, ""],
  [/(\w[\w ]*) went wrong: the interface/, (_, who) => `the outline of ${/\d/.test(who) ? "" : "the "}${who}`],
  [/ went wrong: .* number \d+ is .*/, " is no longer made of numbers. "],
  [/ by [\d.e-]+( at \([^)]*\)), more than [\d.e-]*\d/, "$1"],
  [/marker \d+ of/g, "the outline of"],
  [/markers/g, "points on the outline"],
  [/the time step would have to fall to.*/, "the droplets change too fast to be followed. "],
  [/: [^:]* stopped at a relative residual.*/, ": its equations have no accurate solution here. "],
  [/is \((NaN|inf)[^)]*\), so the run has failed/, "is no longer made of numbers"],
  [/\ba per cent\b/g, "1 %"],
];
/** Bodies are numbered from 0, the droplets first. */
function words(text, droplets = Infinity) {
  const named = (_, word, number) =>
    number < droplets ? `droplet ${Number(number) + 1}` : word === "body" ? "the body inside" : word;
  return WORDS.reduce((told, [word, other]) => told.replace(word, other), text)
    .replace(/(\w+) \(body (\d+)\)/g, named)
    .replace(/\b(body) (\d+)/g, named);
}

/** An error in words; `running` is true for one that ended a run of so many droplets. */
export function plain({ message, key, value, remedy }, running = false, droplets = Infinity) {
  if (/RuntimeError|unreachable|memory access/.test(message))
    return "The computation broke down, which is a fault of this page. Load the page again.";
  if (/TOML parse error/.test(message)) return unreadable(message);
  const named = (remedy ? `“${key} = ${value}” is not possible. ${sentence(remedy)}` : words(message, droplets))
    .replace(/^the scene file is not valid: /, "")
    .replace(/“droplets\[(\d+)\]\.([^”]*)”/, (_, number, entry) => `“${entry}” of droplet ${Number(number) + 1}`)
    .replace(/droplets\[(\d+)\]/g, (_, number) => `droplet ${Number(number) + 1}`)
    .replaceAll("`", "");
  if (!running) return sentence(named);
  const apart = /overlap|gap|crossed/.test(named) ? " or a stronger repulsion" : "";
  return (
    sentence(named.replace(/\. (Use|Move|If|Allow) [^]*/, "")) +
    "\nThe droplets are shown as they were just before. Press R to restart. Then move the slider “Activity” towards 0, " +
    `or give more nodes${apart} in the text below.`
  );
}

/** A doubt about the present state in words: what is uncertain, why, and what to do on the page. */
export function doubt({ body, cause, message }, activity, droplets) {
  const name = (text) => words(text, droplets).replace(/^(?=\D*$)(the )?/, "the ");
  const who = name(body);
  const number = /use (\d+) (?:nodes|elements)/.exec(message)?.[1];
  const gap = /gap from (.*?) is ([\d.e-]+)/.exec(message);
  const spacing = /wall spacing of ([\d.]+)/.exec(message)?.[1];
  const told = {
    "tension negative":
      `The particles on ${who} are so crowded that, at this activity, they push its surface apart. ` +
      (activity > 0
        ? "Choose an activity nearer to 0."
        : "Its shape is uncertain until the crowd has spread: wait, or change the activity in smaller steps."),
    "edge of the concentration not resolved":
      `The edge of the crowd on ${who} is too sharp for the points on the outline, so speeds may be off by more than ` +
      "1 %. Move the slider “Activity” towards 0 or “Diffusion” to the right, or give " +
      `elements = ${number} in the text below.`,
    "shape not resolved":
      `The outline of ${who} has too few points, so speeds may be off by 2 %. Give nodes = ${number} in the text below.`,
    "stresslet not resolved": `The stresslet of ${who} is uncertain. Give more nodes and elements in the text below.`,
    "thin film":
      gap &&
      `The gap between ${who} and ${name(gap[1])} is ${Number(Number(gap[2]).toPrecision(2))}, too narrow for the points on the ` +
        "outline, so speeds may be off by more than 1 %. Drag the droplet away, or give " +
        `${spacing ? `the walls spacing = ${spacing}` : number ? `nodes = ${number}` : "more nodes"} in the text below.`,
  }[cause];
  return told || `These results may be inaccurate: ${sentence(words(`${who}: ${message}`, droplets))}`;
}
