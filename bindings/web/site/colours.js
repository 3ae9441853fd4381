// Colours of the picture in both themes.

const STOPS = {
  light: [
    [0, [150, 190, 208]],
    [0.3, [70, 130, 168]],
    [0.55, [108, 74, 140]],
    [0.78, [204, 68, 84]],
    [1, [240, 122, 36]],
  ],
  dark: [
    [0, [58, 92, 118]],
    [0.3, [72, 146, 190]],
    [0.55, [152, 112, 200]],
    [0.78, [240, 96, 110]],
    [1, [255, 190, 92]],
  ],
};
const PRESSURES = {
  light: [
    [38, 108, 160],
    [238, 243, 244],
    [196, 84, 48],
  ],
  dark: [
    [44, 120, 180],
    [16, 25, 38],
    [206, 88, 52],
  ],
};
/** Number of colours along a scale. */
export const LEVELS = 32;

export function theme() {
  return document.documentElement.dataset.theme === "dark" ? "dark" : "light";
}

function mixed(a, b, part) {
  return a.map((value, k) => Math.round(value + (b[k] - value) * part));
}

/** Colour of a concentration over the top of the scale, as [r, g, b]. */
export function particles(part, name = theme()) {
  const stops = STOPS[name];
  const at = Math.min(Math.max(part, 0), 1);
  let k = 1;
  while (k < stops.length - 1 && stops[k][0] < at) k += 1;
  const [[low, a], [high, b]] = [stops[k - 1], stops[k]];
  return mixed(a, b, (at - low) / (high - low));
}

/** Colour of a pressure from -1 to 1. */
export function pressure(part, name = theme()) {
  const [low, middle, high] = PRESSURES[name];
  const at = Math.min(Math.max(part, -1), 1);
  return at < 0 ? mixed(middle, low, -at) : mixed(middle, high, at);
}

export function rgb(list, alpha = 1) {
  return `rgba(${list.join(",")},${alpha})`;
}

/** Colour of the theme by the name of its property. */
export function property(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
