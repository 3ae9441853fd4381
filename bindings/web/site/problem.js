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

/** Words for a key that a scene does not have. */
function unknown(key, keys) {
  const [nearest] = [...keys].sort((a, b) => distance(a, key) - distance(b, key));
  const guess = nearest && distance(nearest, key) <= Math.max(2, key.length / 3) ? ` Did you mean “${nearest}”?` : "";
  return `A scene has no key “${key}” here.${guess}\nKeys that can stand here: ${keys.join(", ")}.`;
}

/** Words for what the reader of the text stumbles over. */
function unreadable(message) {
  const line = /at line (\d+)/.exec(message)?.[1];
  const quoted = /\n\s*\d+ \| (.*)\n/.exec(message)?.[1]?.trim();
  const reason = (message.split(/\|\s*\^+/).at(-1) ?? message).replace(/[\s.]*Correct this entry\.?\s*$/, "").trim();
  const start = line ? `Line ${line}${quoted ? ` (${quoted})` : ""} cannot be read. ` : "The text cannot be read. ";
  const field = /unknown (?:field|variant) `([^`]*)`, expected (?:one of )?(.*)/s.exec(reason);
  if (field) return start + unknown(field[1], [...field[2].matchAll(/`([^`]*)`/g)].map(([, key]) => key));
  const type = /invalid type: (.*?), expected (.*)/s.exec(reason);
  if (type) {
    const wanted = { f64: "a number", usize: "a whole number", bool: "true or false" }[type[2].trim()] ?? type[2];
    return `${start}It has ${type[1].replace(/^string/, "the text")}. Give ${wanted} instead.`;
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
