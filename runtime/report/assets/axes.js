// Scales, ticks and axes of one panel.

function scale([low, high], [from, to], logarithmic) {
  if (logarithmic) {
    const inner = scale([Math.log10(low), Math.log10(high)], [from, to]);
    const place = (value) => inner(Math.log10(value));
    place.inverse = (pixel) => 10 ** inner.inverse(pixel);
    return place;
  }
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

// Both ranges with the same scale in a frame of these proportions, width over height: one is widened about its middle.
function equalised([x, y], proportions) {
  const widened = ([low, high], length) => [(low + high - length) / 2, (low + high + length) / 2];
  const [wide, tall] = [x[1] - x[0], y[1] - y[0]];
  return wide < proportions * tall ? [widened(x, proportions * tall), y] : [x, widened(y, wide / proportions)];
}

// Round numbers within a range, about so many; of wide angles such as divide a turn.
function ticks([low, high], count, unit) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const turns = unit === "deg" && rough > 10 ? [15, 30, 45, 90, 180] : [];
  const step = [...turns, ...[1, 2, 5, 10].map((factor) => power * factor)].find((own) => own >= rough * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) {
    found.push(Number((k * step).toPrecision(12)));
  }
  return found;
}

// Tens within a range, with twice and five times these where there is room; within less than a ten, equal steps.
function ratios([low, high], count) {
  const decades = Math.log10(high / low);
  if (decades < 1) return ticks([low, high], count);
  const factors = count / decades >= 3 ? [1, 2, 5] : [1];
  const found = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += 1) {
    found.push(...factors.map((factor) => Number((factor * 10 ** power).toPrecision(12))));
  }
  return found.filter((value) => value >= low && value <= high);
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
  const found = axis.logarithmic ? ratios(range, count) : ticks(range, count, axis.unit);
  return found.map((value) => [value, numberText(value)]);
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
