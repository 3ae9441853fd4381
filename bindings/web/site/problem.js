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

/** An error in words; `running` is true for one that ended a run. */
export function plain({ message, key, value, remedy }, running = false) {
  if (/RuntimeError|unreachable|memory access/.test(message))
    return "The computation broke down, which is a fault of this page. Load the page again.";
  if (/TOML parse error/.test(message)) return unreadable(message);
  const what = remedy ? `“${key} = ${value}” is not possible. ${sentence(remedy)}` : message;
  const named = what
    .replace(/^the scene file is not valid: /, "")
    .replace(/droplets\[(\d+)\]/g, (_, number) => `droplet ${Number(number) + 1}`)
    .replaceAll("`", "");
  const end = "\nThe droplets are shown as they were just before. Press R to restart, or choose a weaker activity.";
  return sentence(named) + (running ? end : "");
}
