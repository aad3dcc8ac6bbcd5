// Copies a table as lines of cells between tabs, with all its digits: what a spreadsheet takes.

function tableText({ columns }) {
  const head = columns.map(({ name, unit }) => (unit ? `${name} [${unit}]` : name));
  const rows = columns.length > 0 ? columns[0].values.map((_, row) => columns.map(({ values }) => cellText(values[row]))) : [];
  return [head, ...rows].map((cells) => cells.join("\t")).join("\n");
}

// A spreadsheet takes a text that begins like a formula for one.
function cellText(value) {
  if (value === null || value === undefined) return "";
  if (typeof value === "number" || typeof value === "boolean") return String(value);
  const flat = String(value).replace(/[\t\r\n]+/g, " ");
  return /^[=+\-@]/.test(flat) ? `'${flat}` : flat;
}

function addCopyButton(box, table) {
  const status = box.querySelector("[role=status]");
  box.querySelector("[data-copy]").addEventListener("click", async () => {
    const text = tableText(table);
    const done = await copied(text);
    status.textContent = done ? " Copied." : " The browser refuses: select the table instead.";
  });
}

async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return copiedBySelection(text);
  }
}

// Where a page that is opened from a file has no clipboard of its own.
function copiedBySelection(text) {
  const area = htmlElement("textarea", { class: "offstage", "aria-hidden": "true" }, document.body);
  area.value = text;
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  return done;
}
