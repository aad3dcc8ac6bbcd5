// Scales, ticks and axes of one panel.

function scale([low, high], [from, to]) {
  const slope = (to - from) / (high - low);
  const place = (value) => from + slope * (value - low);
  place.inverse = (pixel) => low + (pixel - from) / slope;
  return place;
}

// A range that has a length.
function proper([low, high]) {
  if (high > low) return [low, high];
  const half = Math.abs(low) * 0.05 || 1;
  return [low - half, low + half];
}

// Round numbers within a range, about so many.
function ticks([low, high], count) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => power * factor >= rough * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) {
    found.push(Number((k * step).toPrecision(12)));
  }
  return found;
}

function heading(axis) {
  return axis.unit ? `${axis.name} [${axis.unit}]` : axis.name;
}

// Places and names of what stands along an axis.
function marksOf(axis, range, count) {
  if (axis.categories.length > 0) {
    const all = axis.categories.map((name, place) => [place, name]);
    return all.filter(([place]) => place >= range[0] && place <= range[1]);
  }
  return ticks(range, count).map((value) => [value, numberText(value)]);
}

function shortened(text, letters) {
  return text.length > letters ? `${text.slice(0, letters - 1)}\u2026` : text;
}

// What an interactive reader asks of a value on an axis: a category by name, a number with its unit.
function valueText(axis, value) {
  const category = axis.categories[Math.round(value)];
  if (category !== undefined) return category;
  return axis.unit ? `${numberText(value)} ${axis.unit}` : numberText(value);
}
